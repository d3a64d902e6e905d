"""``GripperActionController``: a gripper of one joint that closes until it is there or stalls."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Bools, Floats, Ints64, Worlds
from gazelle.control.control_law import ControlLaw
from gazelle.control.controller import Controller
from gazelle.control.goals import ActionPort, Goal, GoalState
from gazelle.control.gripper_law import GripperLaw
from gazelle.control.interfaces import EFFORT
from gazelle.control.parameters import ControllerParameters
from gazelle.control.pid import PID_TUNABLES, Pid, PidGains, pid_changer, pid_values
from gazelle.control.publishing import PublishingSchedule
from gazelle.control.values import GripperGoal, GripperResult
from gazelle.engines.limits import NANOSECONDS


class GripperActionController(Controller):
    """Moves one joint to a position, with a largest effort where it commands efforts.

    Attributes:
        action_name: Of its action.
        tolerance: Within which a goal is reached, unless ``goal_tolerance`` says otherwise.
        stall_ends: Outcome of a goal when the gripper stalls.
    """

    action_name = "gripper_cmd"
    tolerance = 0.01
    stall_ends = GoalState.ABORTED
    _law: GripperLaw | None = None

    def init(self, parameters: ControllerParameters) -> None:
        """Read ``joint``, tolerances, ``max_effort`` and, to command efforts, ``gains``."""
        name = parameters.text("joint")
        self._joint = self.claim(self.interfaces[0], [name])
        self._pid: Pid | None = None
        if self.interfaces == (EFFORT,):
            pid = self._pid = Pid([PidGains.read(parameters.part(f"gains/{name}"))], self.nworld)
            read = pid_values
            self.add_tuning(f"gains/{name}", PID_TUNABLES, lambda: read(pid), pid_changer(pid))
        self._take_goals(parameters, 0.0)
        self._law = GripperLaw(self._joint, self._position, self._max_effort, self._output)
        if self._pid is not None:
            self._law.push_by(self._pid.law)

    def _take_goals(self, parameters: ControllerParameters, strength: float) -> None:
        """Open the action; ``strength`` is the default of ``max_effort``."""
        self._tolerance = parameters.number("goal_tolerance", self.tolerance)
        self._strength = abs(parameters.number("max_effort", strength))
        self._slow = parameters.number("stall_velocity_threshold", 0.001)
        self._patience_ns = round(parameters.number("stall_timeout", 1.0) * NANOSECONDS)
        rate = parameters.number("action_monitor_rate", 20.0)
        self._feedback_due = PublishingSchedule(rate)
        self.add_action(
            self.action_name,
            lambda topic, call: ActionPort(
                topic,
                GripperGoal,
                GripperResult,
                GripperResult,
                begin=self._begin_goal,
                stop=self._stop_goal,
                nworld=self.nworld,
                call=call,
                monitor_rate=rate,
            ),
        )
        self._position: Floats = np.zeros(self.nworld)
        self._max_effort: Floats = np.zeros(self.nworld)
        self._moved_ns: Ints64 = np.zeros(self.nworld, np.int64)
        self._goals: list[Goal[GripperGoal]] = []
        self._active: Bools = np.zeros(self.nworld, bool)
        self._output: Floats = np.zeros(self.nworld)

    # -- goals ---------------------------------------------------------------------------

    def _begin_goal(self, goal: Goal[GripperGoal]) -> None:
        if not self.running:
            text = "can't accept new action goals: controller is not running"
            goal.end(GoalState.REJECTED, None, GripperResult(), text)
            return
        rows = goal.worlds
        self._preempt(rows, "another goal took its place")
        goal.accept()
        self._goals.append(goal)
        self._position[rows] = goal.value.position
        self._max_effort[rows] = goal.value.max_effort
        self._moved_ns[rows] = self.now_ns
        self._active[rows] = True

    def _stop_goal(self, goal: Goal[GripperGoal]) -> None:
        if goal in self._goals:
            rows = goal.worlds[goal.states == GoalState.ACTIVE]
            self._hold(rows)
            self._preempt(rows, "the goal was cancelled")

    def _preempt(self, rows: Worlds, why: str) -> None:
        self._end(rows, GoalState.PREEMPTED, why)

    def _end(self, rows: Worlds, state: GoalState, text: str = "", **flags: bool) -> None:
        """End the active goals in some worlds."""
        self._active[rows] = False
        for goal in tuple(self._goals):
            for world in np.intersect1d(goal.worlds, rows).tolist():
                result = self._result(world, **flags)
                goal.end(state, np.array([world]), result, text)
            if goal.done:
                self._goals.remove(goal)

    def _result(self, world: int, *, stalled: bool = False, reached: bool = False) -> GripperResult:
        position = float(self._opening()[world])
        return GripperResult(position, float(self._output[world]), stalled, reached)

    def _opening(self) -> Floats:
        """Return the opening of the gripper as goals define it, shape (nworld,)."""
        return self._joint.position[:, 0]

    def _speed(self) -> Floats:
        """Return the rate of change of the opening, shape (nworld,)."""
        return self._joint.velocity[:, 0]

    def _hold(self, rows: Worlds) -> None:
        self._position[rows] = self._opening()[rows]
        self._max_effort[rows] = self._strength

    # -- the loop ----------------------------------------------------------------------

    def starting(self, time: float) -> None:  # noqa: ARG002  at any time
        """Hold the joint at its position."""
        self._feedback_due.start(self.now_ns, at_once=False)
        self._begin(np.arange(self.nworld))

    def _begin(self, rows: Worlds) -> None:
        self._hold(rows)
        self._moved_ns[rows] = self.now_ns
        if self._pid is None:
            self._joint.set_command(self._joint.position[rows], None, rows)
        else:
            self._pid.reset(rows)
            self._joint.set_command(0.0, None, rows)

    def update(self, time: float, period: float) -> None:  # noqa: ARG002  the clock is exact
        """Move the gripper, and check whether it has arrived or stalled."""
        error = self._position - self._opening()
        self._check_goals(error, self._speed())
        if self._law is not None:
            self._law.act(self.now_ns, period)
        else:
            self._push(error, period)
        if self._goals and self._feedback_due.is_due(self.now_ns):
            for goal in self._goals:
                if goal.has_feedback_callbacks:
                    goal.publish_feedback(self._result(int(goal.worlds[0])))

    def law(self) -> ControlLaw | None:
        """Return the law that holds the joint; None where a subclass drives it in its own way."""
        return self._law

    def wake_ns(self) -> float:
        """Return 0 while a goal may end: update always."""
        return 0.0 if self._goals else math.inf

    def _push(self, error: Floats, period: float) -> None:
        """Command the joint, for what is missing of the position, shape (nworld,), without a law."""

    def _check_goals(self, error: Floats, velocity: Floats) -> None:
        there = self._active & (np.abs(error) < self._tolerance)
        if there.any():
            self._end(np.flatnonzero(there), GoalState.SUCCEEDED, reached=True)
        moving = np.abs(velocity) > self._slow
        self._moved_ns[moving] = self.now_ns
        late = self.now_ns - self._moved_ns > self._patience_ns
        stalled = self._active & ~moving & late
        if stalled.any():
            text = "the gripper stalled before it was there"
            self._end(np.flatnonzero(stalled), self.stall_ends, text, stalled=True)

    def stopping(self, time: float) -> None:  # noqa: ARG002  at any time
        """End goals."""
        self._preempt(np.arange(self.nworld), "the controller was stopped")

    def reset(self, worlds: Worlds | None) -> None:
        """Hold the joint at its reset position."""
        rows = self.rows(worlds)
        self._preempt(rows, "the simulation was reset")
        if self.running:
            self._begin(rows)

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Return the targets; goals are not stored."""
        inner = {} if self._pid is None else self._pid.state()
        return {
            "position": self._position.copy(),
            "max_effort": self._max_effort.copy(),
            "moved": self._moved_ns.copy(),
            **{f"pid/{name}": value for name, value in inner.items()},
        }

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned; goals end."""
        self._preempt(np.arange(self.nworld), "a snapshot was restored")
        self._position[:], self._max_effort[:] = state["position"], state["max_effort"]
        self._moved_ns[:] = state["moved"]
        if self._pid is not None:
            self._pid.restore({name: state[f"pid/{name}"] for name in ("p", "i", "last")})
