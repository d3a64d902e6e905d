"""``JointTrajectoryController`` of the five packages of ros_controllers that have one."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Worlds
from gazelle.control.angles import shortest
from gazelle.control.control_law import ControlLaw
from gazelle.control.controller import Controller, state_below
from gazelle.control.goals import ActionPort, Goal, GoalState
from gazelle.control.parameters import ControllerParameters
from gazelle.control.pid import PID_TUNABLES, Pid, PidGains, pid_changer, pid_values
from gazelle.control.publishing import PublishingSchedule
from gazelle.control.tolerances import TrajectoryTolerances
from gazelle.control.trajectory import TrajectoryTable
from gazelle.control.trajectory_law import (
    LATE,
    NOTHING,
    STRAYED,
    THERE,
    TrajectoryLaw,
    TrajectoryMemory,
)
from gazelle.control.trajectory_messages import (
    TrajectoryRefusedError,
    check_points,
    columns_of,
    waypoints,
)
from gazelle.control.values import (
    GOAL_TOLERANCE_VIOLATED,
    PATH_TOLERANCE_VIOLATED,
    JointSample,
    JointTrajectory,
    TrajectoryAnswer,
    TrajectoryGoal,
    TrajectoryQuery,
    TrajectoryResult,
    TrajectoryState,
)
from gazelle.description import Joint
from gazelle.errors import ControlError

_NOT_RUNNING = "can't accept new commands: controller is not running"
_SECOND = 1e-9


class JointTrajectoryController(Controller):
    """Moves joints through points at times: a topic, an action, or from Python.

    It counts time from its start by adding periods up, so that jumps of the clock do not move what it
    follows. All worlds start together; each may follow a trajectory of its own.
    """

    def init(self, parameters: ControllerParameters) -> None:
        """Read ``joints``, ``constraints``, ``gains``, ``velocity_ff`` and the rates."""
        names = parameters.names("joints")
        self._names = names
        self._endless = np.array([_is_endless(self.description_of(name)) for name in names], bool)
        self._joints = self.claim(self.interfaces[0], names)
        self._tolerances = TrajectoryTolerances.read(parameters, names)
        self._partial = parameters.flag("allow_partial_joints_goal", default=False)
        self._stop_duration = parameters.number("stop_trajectory_duration", 0.0)
        memory = self._memory = TrajectoryMemory.empty(self.nworld, len(names))
        self._law = TrajectoryLaw(self._joints, memory)
        self._adapt(parameters)
        self._open(parameters)
        self._table = TrajectoryTable(self.nworld, len(names), self._endless)
        self._table.followers.append(self._law.follow)
        self._table.notify()
        self._goals: dict[int, Goal[TrajectoryGoal]] = {}
        self._numbers = 0
        self._followed = False  # whether there was an update since it started again

    def _adapt(self, parameters: ControllerParameters) -> None:
        """Set up the conversion of targets to commands: direct, or by PID."""
        self._pid: Pid | None = None
        fields = self._joints.fields
        if fields not in (("velocity",), ("effort",)):
            return
        gains = []
        for name in self._names:
            part = parameters.part(f"gains/{name}")
            if "p" not in part:
                raise ControlError(
                    f"there are no gains '{part.place}/p', which a trajectory controller needs",
                    hint=f"set gains/{name}: {{p: ..., i: ..., d: ..., i_clamp: ...}}",
                )
            gains.append(PidGains.read(part))
        self._pid = Pid(gains, self.nworld)
        forward = np.array([parameters.number(f"velocity_ff/{n}", 0.0) for n in self._names])
        self._law.push_by(self._pid.law, forward, self._joints.commands[fields[0]][0])
        for loop, name in enumerate(self._names):
            read, change = self._gains_of(loop), pid_changer(self._pid, loop)
            self.add_tuning(f"gains/{name}", PID_TUNABLES, read, change)

    def _gains_of(self, loop: int) -> Any:
        pid = self._pid
        return lambda: {} if pid is None else pid_values(pid, loop)

    def _open(self, parameters: ControllerParameters) -> None:
        self._state_port = self.add_output("state", TrajectoryState, self._state)
        self._state_due = PublishingSchedule(parameters.number("state_publish_rate", 50.0))
        self.add_input("command", JointTrajectory, self._receive)
        self.add_query("query_state", TrajectoryQuery, TrajectoryAnswer, self._answer)
        rate = parameters.number("action_monitor_rate", 20.0)
        self._feedback_due = PublishingSchedule(rate)
        self.add_action(
            "follow_joint_trajectory",
            lambda topic, call: ActionPort(
                topic,
                TrajectoryGoal,
                TrajectoryState,
                TrajectoryResult,
                begin=self._begin_goal,
                stop=self._stop_goal,
                nworld=self.nworld,
                call=call,
                monitor_rate=rate,
            ),
        )

    # -- the loop ----------------------------------------------------------------------

    @property
    def _uptime(self) -> float:
        """Since the start, the same in all worlds [s]."""
        return float(self._memory.uptime[0])

    @property
    def _period(self) -> float:
        return float(self._memory.period[0])

    def starting(self, time: float) -> None:  # noqa: ARG002  it counts its own time
        """Hold the joints at their positions."""
        self._memory.uptime[:] = 0.0
        self._begin(np.arange(self.nworld))
        self._state_due.start(self.now_ns, at_once=False)
        self._feedback_due.start(self.now_ns, at_once=False)

    def _begin(self, rows: Worlds) -> None:
        """Hold the joints of some worlds at their positions."""
        position = self._joints.position[rows]
        self._table.hold(self._uptime, position, rows)
        if self._pid is not None:
            self._pid.reset(rows)
        for field in self._joints.fields:
            held = position if field == "position" else 0.0
            self._joints.set_command(held, field, rows)
        self._followed = False

    def update(self, time: float, period: float) -> None:  # noqa: ARG002  it counts its own time
        """Follow the trajectories."""
        self._law.act(self.now_ns, period)
        self._followed = True
        goals = tuple(self._goals.values())
        self._look_back()
        if self._state_due.is_due(self.now_ns):
            self._state_port.publish()
        if goals and self._feedback_due.is_due(self.now_ns):
            for goal in tuple(self._goals.values()):
                if goal.has_feedback_callbacks:
                    goal.publish_feedback(self._state())

    def law(self) -> ControlLaw:
        """Return the law applied to the joints."""
        return self._law

    def wake_ns(self) -> float:
        """Return 0 while goals have subscribers, else the next time to publish."""
        if any(goal.watched for goal in self._goals.values()):
            return 0.0
        return self._state_due.next_ns if self._state_port.has_subscribers else math.inf

    @property
    def deferrable(self) -> bool:
        """Not while goals may end."""
        return not self._goals

    def catch_up(self, updates: int, period: float) -> None:  # noqa: ARG002  its memory has it
        """End goals that ended in native updates."""
        self._followed = True
        self._state_due.skip(self.now_ns, updates)
        if self._goals:
            self._feedback_due.skip(self.now_ns, updates)
        self._look_back()

    def stopping(self, time: float) -> None:  # noqa: ARG002  at any time
        """End the trajectory; the joints keep their last commands."""
        self._preempt(np.arange(self.nworld), "the controller was stopped")

    # -- goals ---------------------------------------------------------------------------

    def _look_back(self) -> None:
        """End goals that are reached or failed."""
        memory = self._memory
        if not self._goals or not memory.event.any():
            return
        ended = np.flatnonzero(memory.event)
        codes = memory.event[ended]
        memory.event[ended] = NOTHING
        memory.goal[ended] = memory.event_goal[ended]
        for kind, code, what in (
            (STRAYED, PATH_TOLERANCE_VIOLATED, "path"),
            (LATE, GOAL_TOLERANCE_VIOLATED, "goal"),
        ):
            for world in ended[codes == kind].tolist():
                joint = self._names[memory.event_joint[world]]
                error = f"{joint} {what} error {memory.event_error[world]:.6f}"
                result = TrajectoryResult(code, error)
                self._end_goals(np.array([world]), GoalState.ABORTED, result, error)
        done = ended[codes == THERE]
        if done.size:
            self._end_goals(done, GoalState.SUCCEEDED, TrajectoryResult(), "")

    def _end_goals(
        self, rows: Worlds, state: GoalState, result: TrajectoryResult | None, text: str
    ) -> None:
        """End the active goals in some worlds."""
        numbers = self._memory.goal[rows]
        self._memory.goal[rows] = 0
        for number in np.unique(numbers[numbers > 0]).tolist():
            goal = self._goals[number]
            goal.end(state, rows[numbers == number], result, text)
            if not (self._memory.goal == number).any():
                del self._goals[number]

    def _preempt(self, rows: Worlds, why: str) -> None:
        if self._goals:
            self._end_goals(rows, GoalState.PREEMPTED, TrajectoryResult(), why)

    def _begin_goal(self, goal: Goal[TrajectoryGoal]) -> None:
        try:
            self._take(goal.value.trajectory, goal.worlds, self._numbers + 1)
        except TrajectoryRefusedError as error:
            text = str(error)
            goal.end(GoalState.REJECTED, None, TrajectoryResult(error.code, text), text)
            return
        self._preempt(goal.worlds, "another goal took its place")
        goal.accept()
        if not goal.value.trajectory.points:
            goal.end(GoalState.SUCCEEDED, None, TrajectoryResult())
            return
        self._numbers += 1
        self._goals[self._numbers] = goal
        rows = goal.worlds
        self._memory.goal[rows] = self._numbers
        named = columns_of(goal.value.trajectory, self._names, partial=True)
        self._memory.reached[rows] = ~np.isin(np.arange(len(self._names)), named)
        bounds = self._tolerances.with_goal(goal.value, self._names)
        memory = self._memory
        memory.path[rows], memory.end[rows] = bounds.path, bounds.goal
        memory.patience[rows] = bounds.goal_time

    def _stop_goal(self, goal: Goal[TrajectoryGoal]) -> None:
        """Hold the joints where the goal is active."""
        number = next((n for n, each in self._goals.items() if each is goal), None)
        if number is None:
            return
        rows = np.flatnonzero(self._memory.goal == number)
        self._hold(rows)
        self._preempt(rows, "the goal was cancelled")

    # -- trajectories --------------------------------------------------------------------

    def _receive(self, trajectory: JointTrajectory, worlds: Worlds | None) -> None:
        """Follow a trajectory without a goal."""
        rows = self.rows(worlds)
        self._take(trajectory, rows, 0)
        self._preempt(rows, "another trajectory took its place")

    def _take(self, trajectory: JointTrajectory, rows: Worlds, goal: int) -> None:
        """Follow a trajectory from the next update on.

        Raises:
            TrajectoryRefusedError: It cannot be followed; what is followed continues.
        """
        if not self.running:
            raise TrajectoryRefusedError(_NOT_RUNNING)
        # A goal must name the joints even if it has no points; what comes without a goal need not.
        if trajectory.points or goal:
            joints = columns_of(trajectory, self._names, partial=self._partial)
        if not trajectory.points:
            self._hold(rows)
            return
        check_points(trajectory, len(joints))
        now = self._uptime + self._period
        begin = now
        if trajectory.stamp:
            next_ns = self.now_ns + round(self._period / _SECOND)
            begin = now + (trajectory.stamp - next_ns) * _SECOND
        points = waypoints(trajectory, joints, begin, now, self.name)
        self._table.follow(points, now, begin, goal, rows)

    def _hold(self, rows: Worlds) -> None:
        """Hold: at once at the joints' positions, or after a ramp."""
        if self._stop_duration > 0.0:
            self._table.ramp(self._uptime, self._stop_duration, rows)
        else:
            self._table.hold(self._uptime, self._joints.position[rows], rows)

    # -- publishing -------------------------------------------------------------------------

    def _state(self) -> TrajectoryState:
        desired = self._desired()
        position, velocity = self._joints.position, self._joints.velocity
        return TrajectoryState(
            self.now_ns,
            self._names,
            desired,
            JointSample(position, velocity),
            JointSample(shortest(position, desired.positions), desired.velocities - velocity),
            self._uptime - self._table.begins(),
        )

    def _desired(self) -> JointSample:
        """Return the targets of the last update; before the first, those of the next."""
        memory = self._memory
        if self._followed:
            columns = memory.desired_position, memory.desired_velocity, memory.desired_acceleration
            return JointSample(*(each.copy() for each in columns))
        now = self._table.sample(self._uptime)
        return JointSample(now.position, now.velocity, now.acceleration)

    def _answer(self, query: TrajectoryQuery) -> TrajectoryAnswer:
        if not self.running:
            raise ControlError("can't sample trajectory: controller is not running")
        moment = self._uptime + (query.stamp - self.now_ns) * _SECOND
        if moment < self._table.begins().min():
            raise ControlError("requested sample time precedes trajectory start time")
        found = self._table.sample(moment)
        sample = JointSample(found.position, found.velocity, found.acceleration)
        return TrajectoryAnswer(self._names, sample)

    # -- restarting --------------------------------------------------------------------

    def reset(self, worlds: Worlds | None) -> None:
        """Hold the joints at their reset positions."""
        rows = self.rows(worlds)
        self._preempt(rows, "the simulation was reset")
        if worlds is None:
            self._state_due.start(self.now_ns, at_once=False)
            self._feedback_due.start(self.now_ns, at_once=False)
        if self.running:
            self._begin(rows)

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Return the trajectory that is followed; goals are not stored."""
        inner = {} if self._pid is None else self._pid.state()
        return {
            "uptime": np.array([self._uptime, self._period]),
            **{f"table/{name}": value for name, value in self._table.state().items()},
            **{f"pid/{name}": value for name, value in inner.items()},
            **self._state_due.state(),
        }

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned; goals end."""
        self._preempt(np.arange(self.nworld), "a snapshot was restored")
        self._memory.uptime[:], self._memory.period[:] = state["uptime"]
        self._table.restore(state_below("table/", state))
        if self._pid is not None:
            self._pid.restore(state_below("pid/", state))
        self._state_due.restore(state)
        self._followed = False


def _is_endless(joint: Joint) -> bool:
    if joint.type == "continuous":
        return True
    return joint.type == "revolute" and all(
        math.isinf(axis.lower) and math.isinf(axis.upper) for axis in joint.axes
    )
