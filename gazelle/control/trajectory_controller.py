"""``JointTrajectoryController`` of the five packages of ros_controllers that have one."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Bools, Floats, Ints64, Worlds
from gazelle.control.angles import shortest
from gazelle.control.controller import Controller
from gazelle.control.goals import ActionPort, Goal, GoalState
from gazelle.control.parameters import ControllerParameters
from gazelle.control.pid import PID_TUNABLES, Pid, PidGains, pid_changer, pid_values
from gazelle.control.publishing import PublishingSchedule
from gazelle.control.tolerances import TrajectoryTolerances, within
from gazelle.control.trajectory import TrajectorySample, TrajectoryTable
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
        self._adapt(parameters)
        self._open(parameters)
        shape = (self.nworld, len(names))
        self._table = TrajectoryTable(*shape, self._endless)
        self._uptime = 0.0
        self._period = 0.0
        self._goals: dict[int, Goal[TrajectoryGoal]] = {}
        self._goal: Ints64 = np.zeros(self.nworld, np.int64)
        self._numbers = 0
        self._reached: Bools = np.zeros(shape, bool)
        self._path: Floats = np.zeros((*shape, 3))
        self._end: Floats = np.zeros((*shape, 3))
        self._patience: Floats = np.zeros(self.nworld)
        self._desired: TrajectorySample | None = None

    def _adapt(self, parameters: ControllerParameters) -> None:
        """How what is wanted becomes a command: as it is, or by PID."""
        self._pid: Pid | None = None
        fields = self._joints.fields
        if fields not in (("velocity",), ("effort",)):
            return
        gains = []
        for name in self._names:
            part = parameters.part(f"gains/{name}")
            if "p" not in part:
                raise ControlError(
                    f"there are no gains '{part.place}/p', and without gains a trajectory is not followed",
                    hint=f"set gains/{name}: {{p: ..., i: ..., d: ..., i_clamp: ...}}",
                )
            gains.append(PidGains.read(part))
        self._pid = Pid(gains, self.nworld)
        self._forward = np.array([parameters.number(f"velocity_ff/{n}", 0.0) for n in self._names])
        for loop, name in enumerate(self._names):
            tell, change = self._gains_of(loop), pid_changer(self._pid, loop)
            self.add_tuning(f"gains/{name}", PID_TUNABLES, tell, change)

    def _gains_of(self, loop: int) -> Any:
        pid = self._pid
        return lambda: {} if pid is None else pid_values(pid, loop)

    def _open(self, parameters: ControllerParameters) -> None:
        self._state_port = self.add_output("state", TrajectoryState, self._tell)
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

    def starting(self, time: float) -> None:  # noqa: ARG002  it counts its own time
        """Hold the joints where they are."""
        self._uptime = 0.0
        self._begin(np.arange(self.nworld))
        self._state_due.start(self.now_ns, at_once=False)
        self._feedback_due.start(self.now_ns, at_once=False)

    def _begin(self, rows: Worlds) -> None:
        """Hold the joints of some worlds where they are."""
        position = self._joints.position[rows]
        self._table.hold(self._uptime, position, rows)
        if self._pid is not None:
            self._pid.reset(rows)
        for field in self._joints.fields:
            held = position if field == "position" else 0.0
            self._joints.set_command(held, field, rows)
        self._desired = None

    def update(self, time: float, period: float) -> None:  # noqa: ARG002  it counts its own time
        """Follow."""
        self._uptime += period
        self._period = period
        desired = self._table.sample(self._uptime)
        self._desired = desired
        position = self._joints.position
        position_error = shortest(position, desired.position)
        velocity_error = desired.velocity - self._joints.velocity
        if self._goals:
            self._check(desired, position_error, velocity_error)
        self._command(desired, position_error, velocity_error, period)
        if self._state_due.is_due(self.now_ns):
            self._state_port.publish()
        if self._goals and self._feedback_due.is_due(self.now_ns):
            for goal in tuple(self._goals.values()):
                if goal.heard:
                    goal.tell(self._tell())

    def _command(
        self, desired: TrajectorySample, position: Floats, velocity: Floats, period: float
    ) -> None:
        if self._pid is not None:
            pushed = self._pid.compute(position, period, velocity)
            self._joints.set_command(self._forward * desired.velocity + pushed)
            return
        for field in self._joints.fields:
            self._joints.set_command(getattr(desired, field), field)

    def stopping(self, time: float) -> None:  # noqa: ARG002  at any time
        """End what is followed; the joints keep their last commands."""
        self._preempt(np.arange(self.nworld), "the controller was stopped")

    # -- goals ---------------------------------------------------------------------------

    def _check(self, desired: TrajectorySample, position: Floats, velocity: Floats) -> None:
        """End goals that are reached, or missed."""
        own = (desired.goal == self._goal[:, None]) & (self._goal[:, None] > 0)
        going = own & (self._uptime < desired.end)
        strayed = going & ~within(position, velocity, self._path)
        ended = own & ~going & desired.last
        there = within(position, velocity, self._end)
        self._reached |= ended & there
        late = ended & ~there & (self._uptime >= desired.end + self._patience[:, None])
        for missed, code, what in (
            (strayed, PATH_TOLERANCE_VIOLATED, "path"),
            (late, GOAL_TOLERANCE_VIOLATED, "goal"),
        ):
            for world in np.flatnonzero(missed.any(axis=1)).tolist():
                joint = int(np.argmax(missed[world]))
                error = f"{self._names[joint]} {what} error {position[world, joint]:.6f}"
                result = TrajectoryResult(code, error)
                self._end_goals(np.array([world]), GoalState.ABORTED, result, error)
        done = np.flatnonzero((self._goal > 0) & self._reached.all(axis=1))
        if done.size:
            self._end_goals(done, GoalState.SUCCEEDED, TrajectoryResult(), "")

    def _end_goals(
        self, rows: Worlds, state: GoalState, result: TrajectoryResult | None, text: str
    ) -> None:
        """End the goals that are active in some worlds."""
        numbers = self._goal[rows]
        self._goal[rows] = 0
        for number in np.unique(numbers[numbers > 0]).tolist():
            goal = self._goals[number]
            goal.end(state, rows[numbers == number], result, text)
            if not (self._goal == number).any():
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
        self._goal[rows] = self._numbers
        named = columns_of(goal.value.trajectory, self._names, partial=True)
        self._reached[rows] = ~np.isin(np.arange(len(self._names)), named)
        bounds = self._tolerances.with_goal(goal.value, self._names)
        self._path[rows], self._end[rows] = bounds.path, bounds.goal
        self._patience[rows] = bounds.goal_time

    def _stop_goal(self, goal: Goal[TrajectoryGoal]) -> None:
        """Hold where it is active; elsewhere nothing happens."""
        number = next((n for n, each in self._goals.items() if each is goal), None)
        if number is None:
            return
        rows = np.flatnonzero(self._goal == number)
        self._hold(rows)
        self._preempt(rows, "the goal was cancelled")

    # -- trajectories --------------------------------------------------------------------

    def _receive(self, given: JointTrajectory, worlds: Worlds | None) -> None:
        """A trajectory without a goal."""
        rows = self.rows(worlds)
        self._take(given, rows, 0)
        self._preempt(rows, "another trajectory took its place")

    def _take(self, given: JointTrajectory, rows: Worlds, goal: int) -> None:
        """Follow from the next update on.

        Raises:
            TrajectoryRefusedError: It cannot be followed; what is followed goes on.
        """
        if not self.running:
            raise TrajectoryRefusedError(_NOT_RUNNING)
        # A goal must name the joints even if it has no points; what comes without a goal need not.
        if given.points or goal:
            joints = columns_of(given, self._names, partial=self._partial)
        if not given.points:
            self._hold(rows)
            return
        check_points(given, len(joints))
        now = self._uptime + self._period
        begin = now
        if given.stamp:
            next_ns = self.now_ns + round(self._period / _SECOND)
            begin = now + (given.stamp - next_ns) * _SECOND
        points = waypoints(given, joints, begin, now, self.name)
        self._table.follow(points, now, begin, goal, rows)

    def _hold(self, rows: Worlds) -> None:
        """Stand still: at once where the joints are, or after a ramp."""
        if self._stop_duration > 0.0:
            self._table.ramp(self._uptime, self._stop_duration, rows)
        else:
            self._table.hold(self._uptime, self._joints.position[rows], rows)

    # -- telling -------------------------------------------------------------------------

    def _tell(self) -> TrajectoryState:
        desired = self._desired
        if desired is None:
            desired = self._table.sample(self._uptime)
        position, velocity = self._joints.position, self._joints.velocity
        return TrajectoryState(
            self.now_ns,
            self._names,
            JointSample(desired.position, desired.velocity, desired.acceleration),
            JointSample(position, velocity),
            JointSample(shortest(position, desired.position), desired.velocity - velocity),
            self._uptime - self._table.begins(),
        )

    def _answer(self, query: TrajectoryQuery) -> TrajectoryAnswer:
        if not self.running:
            raise ControlError("can't sample trajectory: controller is not running")
        moment = self._uptime + (query.stamp - self.now_ns) * _SECOND
        if moment < self._table.begins().min():
            raise ControlError("requested sample time precedes trajectory start time")
        found = self._table.sample(moment)
        sample = JointSample(found.position, found.velocity, found.acceleration)
        return TrajectoryAnswer(self._names, sample)

    # -- beginning anew --------------------------------------------------------------------

    def reset(self, worlds: Worlds | None) -> None:
        """Hold the joints where they were put."""
        rows = self.rows(worlds)
        self._preempt(rows, "the simulation was reset")
        if worlds is None:
            self._state_due.start(self.now_ns, at_once=False)
            self._feedback_due.start(self.now_ns, at_once=False)
        if self.running:
            self._begin(rows)

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """What is followed; goals are not kept."""
        inner = {} if self._pid is None else self._pid.state()
        return {
            "uptime": np.array([self._uptime, self._period]),
            **{f"table/{name}": value for name, value in self._table.state().items()},
            **{f"pid/{name}": value for name, value in inner.items()},
            **self._state_due.state(),
        }

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Put back what ``state`` gave; goals end."""
        self._preempt(np.arange(self.nworld), "a snapshot was restored")
        self._uptime, self._period = (float(each) for each in state["uptime"])
        self._table.restore(_part("table/", state))
        if self._pid is not None:
            self._pid.restore(_part("pid/", state))
        self._state_due.restore(state)
        self._desired = None


def _part(begin: str, state: Mapping[str, NDArray[np.generic]]) -> dict[str, NDArray[np.generic]]:
    return {k.removeprefix(begin): v for k, v in state.items() if k.startswith(begin)}


def _is_endless(joint: Joint) -> bool:
    if joint.type == "continuous":
        return True
    return joint.type == "revolute" and all(
        math.isinf(axis.lower) and math.isinf(axis.upper) for axis in joint.axes
    )
