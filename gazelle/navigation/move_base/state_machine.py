"""State machine of ``move_base``: plan, follow and recover until a goal is reached or given up.

All in one thread and by a given time: for a node that is the graph's, for robots in a simulation
the simulated one.
"""

from __future__ import annotations

import enum
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from gazelle.argument_checks import checked
from gazelle.array_types import Floats
from gazelle.errors import Error
from gazelle.navigation.following import Pose2
from gazelle.navigation.move_base.recovery import RecoveryBehavior
from gazelle.navigation.move_base.settings import MoveBaseSettings
from gazelle.navigation.planners.planar import composed, inverse
from gazelle.navigation.planners.plugins import (
    STOP,
    GlobalPlannerPlugin,
    LocalPlannerPlugin,
    Velocity,
)

REACHED = "Goal reached."
_RECOVERED = "Even after executing recovery behaviors."
NO_PLAN = f"Failed to find a valid plan. {_RECOVERED}"
NO_CONTROL = f"Failed to find a valid control. {_RECOVERED}"
OSCILLATING = f"Robot is oscillating. {_RECOVERED}"
NOT_PASSED = "Failed to pass global plan to the controller."


class Phase(enum.Enum):
    """State of `MoveBase`."""

    IDLE = "idle"
    PLANNING = "planning"
    CONTROLLING = "controlling"
    CLEARING = "clearing"


class GoalOutcome(enum.Enum):
    """Outcome of a goal."""

    SUCCEEDED = "succeeded"
    ABORTED = "aborted"


class _Trigger(enum.Enum):
    """Why it recovers, with the text if that does not help."""

    PLANNING = NO_PLAN
    CONTROLLING = NO_CONTROL
    OSCILLATION = OSCILLATING


@dataclass(frozen=True, slots=True)
class RobotState:
    """Pose and velocity of a robot.

    Attributes:
        global_pose: Pose in the global costmap's frame.
        local_pose: Pose in the local costmap's frame.
        velocity: Along x and y [m/s], and turning [rad/s].
    """

    global_pose: Pose2
    local_pose: Pose2
    velocity: Velocity


@dataclass(frozen=True, slots=True)
class MoveStep:
    """Result of one control cycle.

    Attributes:
        velocity: To have; None if it is not to be changed.
        outcome: Outcome of the goal, if it ended.
        text: Its message.
        plan: A new global plan, if there is one.
        recovery: Number and name of a recovery behaviour that begins now.
    """

    velocity: Velocity | None = None
    outcome: GoalOutcome | None = None
    text: str = ""
    plan: Floats | None = None
    recovery: tuple[int, str] | None = None


class MoveBase:
    """Takes a robot to goals.

    Args:
        settings: Of ``move_base``.
        planner: Finds paths over the global costmap.
        controller: Follows them over the local one.
        recoveries: Recovery behaviours, in order.

    Attributes:
        phase: Current state.
        goal: In the global costmap's frame.
    """

    def __init__(
        self,
        settings: MoveBaseSettings,
        planner: GlobalPlannerPlugin,
        controller: LocalPlannerPlugin,
        recoveries: Sequence[RecoveryBehavior],
    ) -> None:
        self.settings = settings
        self.planner, self.controller = planner, controller
        self.recoveries = list(recoveries)
        self.phase = Phase.IDLE
        self.goal: Pose2 | None = None
        self._trigger = _Trigger.PLANNING
        self._forget(0.0)
        self._recovery_index = 0
        self._running: RecoveryBehavior | None = None

    @checked(Error)
    def set_goal(self, goal: Pose2, time: float) -> None:
        """Set a goal in the global costmap's frame.

        Raises:
            Error: A number is not finite.
        """
        self.goal = goal
        self.phase = Phase.PLANNING
        self._trigger, self._recovery_index, self._running = _Trigger.PLANNING, 0, None
        self._forget(time)

    def cancel(self) -> None:
        """Cancel the goal."""
        self.goal, self.phase, self._running = None, Phase.IDLE, None

    def _forget(self, time: float) -> None:
        self._last_plan = self._last_control = self._last_oscillation = time
        self._oscillation_pose: Pose2 | None = None
        self._planned_at = -math.inf
        self._retries = 0

    # A cycle ------------------------------------------------------------------------------

    def update(self, time: float, state: RobotState) -> MoveStep:
        """Run one cycle of the controller.

        Args:
            time: Now [s].
            state: State of the robot.
        """
        if self.goal is None:
            return MoveStep()
        if self._away(state.global_pose):
            self._oscillation_pose, self._last_oscillation = state.global_pose, time
            if self._trigger is _Trigger.OSCILLATION:
                self._recovery_index = 0
        plan = None
        if self._is_plan_due(time):
            plan = self._plan(time, state)
            if plan is not None and not self.controller.set_plan(plan):
                return self._end(GoalOutcome.ABORTED, NOT_PASSED)
        if self.phase is Phase.PLANNING:
            return self._wait_for_plan(time)
        step = (
            self._control(time, state)
            if self.phase is Phase.CONTROLLING
            else self._clear(time, state)
        )
        if plan is None:
            return step
        return MoveStep(step.velocity, step.outcome, step.text, plan, step.recovery)

    @checked(Error)
    def make_plan(self, start: Pose2, goal: Pose2, tolerance: float) -> Floats:
        """Return a plan without moving, or one to a place nearby.

        Shape (n, 3), empty without one.
        """
        found = self.planner.make_plan(start, goal)
        if len(found) or tolerance <= 0.0:
            return found
        step = min(3.0 * self.planner.costmap.resolution, tolerance)
        for reach in np.arange(step, tolerance + 1e-9, step):
            for x in np.arange(-reach, reach + 1e-9, step):
                for y in np.arange(-reach, reach + 1e-9, step):
                    if max(abs(x), abs(y)) < reach - 1e-9:
                        continue
                    near = goal[0] + float(x), goal[1] + float(y), goal[2]
                    found = self.planner.make_plan(start, near)
                    if len(found):
                        if self.settings.make_plan_add_unreachable_goal:
                            found = np.vstack((found, np.array([goal])))
                        return found
        return found

    def _away(self, pose: Pose2) -> bool:
        last = self._oscillation_pose
        if last is None:
            return True
        return (
            math.hypot(pose[0] - last[0], pose[1] - last[1]) >= self.settings.oscillation_distance
        )

    def _is_plan_due(self, time: float) -> bool:
        if self.phase is Phase.PLANNING:
            return True
        rate = self.settings.planner_frequency
        return (
            self.phase is Phase.CONTROLLING
            and rate > 0.0
            and time - self._planned_at >= 1.0 / rate - 1e-6
        )

    def _plan(self, time: float, state: RobotState) -> Floats | None:
        """Return a new plan; None if there is none."""
        goal = self.goal
        self._planned_at = time
        plan = np.zeros((0, 3)) if goal is None else self.planner.make_plan(state.global_pose, goal)
        if len(plan):
            self._last_plan, self._retries = time, 0
            if self._trigger is _Trigger.PLANNING:
                self._recovery_index = 0
            if self.phase is Phase.PLANNING:
                self.phase = Phase.CONTROLLING
            return plan
        if self.phase is Phase.PLANNING:
            self._retries += 1
            most = self.settings.max_planning_retries
            late = time > self._last_plan + self.settings.planner_patience
            if late or (0 <= most < self._retries):
                self._recover(_Trigger.PLANNING)
        return None

    def _wait_for_plan(self, time: float) -> MoveStep:
        del time
        return MoveStep(STOP)

    def _control(self, time: float, state: RobotState) -> MoveStep:
        to_local = composed(state.local_pose, inverse(state.global_pose))
        if self.controller.goal_reached(state.local_pose, state.velocity, to_local):
            return self._end(GoalOutcome.SUCCEEDED, REACHED)
        timeout = self.settings.oscillation_timeout
        if timeout > 0.0 and self._last_oscillation + timeout < time:
            # As in the original a velocity is computed all the same: a robot that has none waits
            # for `controller_patience`, and then recoveries follow each other at once.
            self._recover(_Trigger.OSCILLATION)
        velocity = self.controller.command(state.local_pose, state.velocity, to_local)
        if velocity is not None:
            self._last_control = time
            if self._trigger is _Trigger.CONTROLLING:
                self._recovery_index = 0
            return MoveStep(velocity)
        if time > self._last_control + self.settings.controller_patience:
            self._recover(_Trigger.CONTROLLING)
        else:
            self._last_plan, self._retries = time, 0
            self.phase = Phase.PLANNING
        return MoveStep(STOP)

    def _recover(self, why: _Trigger) -> None:
        self._trigger, self.phase = why, Phase.CLEARING

    def _clear(self, time: float, state: RobotState) -> MoveStep:
        """Continue a recovery behaviour, or start the next, or abort."""
        begun = None
        if self._running is None:
            index = self._recovery_index
            if not self.settings.recovery_behavior_enabled or index >= len(self.recoveries):
                return self._end(GoalOutcome.ABORTED, self._trigger.value)
            self._running = self.recoveries[index]
            begun = index, self._running.name
            self._running.begin(state.global_pose, state.local_pose)
        velocity = self._running.update(state.local_pose)
        if velocity is not None:
            return MoveStep(velocity, recovery=begun)
        self._running = None
        self._last_oscillation = self._last_plan = time
        self._retries = 0
        self._recovery_index += 1
        self.phase = Phase.PLANNING
        # A robot that turned is not stopped: from a stand, a base with a least turning rate of more
        # than it can reach within a cycle cannot turn on the spot.
        return MoveStep(recovery=begun)

    def _end(self, outcome: GoalOutcome, text: str) -> MoveStep:
        self.cancel()
        return MoveStep(STOP, outcome, text)


def goal_of(x: float, y: float, yaw: float) -> Pose2:
    """Return a goal's pose.

    Raises:
        Error: A number is not finite.
    """
    if not all(math.isfinite(value) for value in (x, y, yaw)):
        raise Error(f"a goal must have finite numbers, not ({x:g}, {y:g}, {yaw:g})")
    return x, y, yaw
