"""At the goal: stop, then turn to its heading."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from gazelle.array_types import Floats
from gazelle.navigation.angles import wrapped
from gazelle.navigation.following import Pose2
from gazelle.navigation.planners.plugins import STOP, Values, Velocity
from gazelle_ros.base.parameter_values import value_of

_OLD_NAMES = {
    "max_vel_trans": "max_trans_vel",
    "min_vel_trans": "min_trans_vel",
    "max_vel_theta": "max_rot_vel",
    "min_vel_theta": "min_rot_vel",
    "trans_stopped_vel": "trans_stopped_velocity",
    "theta_stopped_vel": "rot_stopped_velocity",
}
"""Names of the parameters before Melodic."""


@dataclass(frozen=True, slots=True)
class VelocityLimits:
    """Velocity limits and goal tolerances of a base; names and defaults are those of ROS."""

    max_vel_trans: float = 0.55
    min_vel_trans: float = 0.1
    max_vel_x: float = 0.55
    min_vel_x: float = 0.0
    max_vel_y: float = 0.1
    min_vel_y: float = -0.1
    max_vel_theta: float = 1.0
    min_vel_theta: float = 0.4
    acc_lim_x: float = 2.5
    acc_lim_y: float = 2.5
    acc_lim_theta: float = 3.2
    xy_goal_tolerance: float = 0.1
    yaw_goal_tolerance: float = 0.1
    trans_stopped_vel: float = 0.1
    theta_stopped_vel: float = 0.1
    latch_xy_goal_tolerance: bool = False

    @classmethod
    def read(cls, values: Values) -> VelocityLimits:
        """Read the parameters, under their present or former names.

        Raises:
            Error: One is of the wrong kind.
        """
        fields: dict[str, Any] = {}
        for name in cls.__slots__:
            old = _OLD_NAMES.get(name, name)
            key = name if name in values else old
            fields[name] = value_of(values, key, getattr(cls(), name))
        return cls(**fields)


class StopRotate:
    """Stops a robot at a goal's place, and turns it.

    Args:
        limits: Of the base.
        period: Between two commands [s].
    """

    def __init__(self, limits: VelocityLimits, period: float) -> None:
        self.limits, self._period = limits, period
        self._latched = False
        self._turning = False

    def reset(self) -> None:
        """Reset for a new plan."""
        self._latched = False

    def at_position(self, pose: Pose2, goal: Pose2) -> bool:
        """Return whether the position of the goal is reached."""
        near = math.hypot(goal[0] - pose[0], goal[1] - pose[1]) <= self.limits.xy_goal_tolerance
        if near and self.limits.latch_xy_goal_tolerance:
            self._latched = True
        if not near and not self._latched:
            self._turning = False
        return near or self._latched

    def reached(self, pose: Pose2, velocity: Velocity, goal: Pose2) -> bool:
        """Return whether position and heading are reached, and the robot stands."""
        turned = abs(wrapped(goal[2] - pose[2])) <= self.limits.yaw_goal_tolerance
        return self.at_position(pose, goal) and turned and self._stands(velocity)

    def command(
        self,
        pose: Pose2,
        velocity: Velocity,
        goal: Pose2,
        fits: Callable[[Floats], bool],
        can_turn: Callable[[float], bool],
    ) -> Velocity | None:
        """Stop, or turn; None if there is no room for it.

        It turns in the shorter direction, as the original, unless only the longer one is free. What the
        original requires of a turn, room to continue for ``sim_time``, is only checked where neither is.

        Args:
            pose: Of the robot.
            velocity: Its velocity.
            goal: In the same frame.
            fits: Predicate of commands that hit nothing.
            can_turn: Predicate of angles of turns on the spot that hit nothing.
        """
        left = wrapped(goal[2] - pose[2])
        if abs(left) <= self.limits.yaw_goal_tolerance:
            self._turning = False
            return STOP
        if not self._turning and not self._stands(velocity):
            command = self._braked(velocity)
            return command if fits(np.array([command])) else None
        self._turning = True
        around = left - math.copysign(2.0 * math.pi, left)
        free = next((angle for angle in (left, around) if can_turn(angle)), None)
        command = 0.0, 0.0, self._turn(left if free is None else free, velocity[2])
        return command if free is not None or fits(np.array([command])) else None

    def _stands(self, velocity: Velocity) -> bool:
        slow = math.hypot(velocity[0], velocity[1]) <= self.limits.trans_stopped_vel
        return slow and abs(velocity[2]) <= self.limits.theta_stopped_vel

    def _braked(self, velocity: Velocity) -> Velocity:
        own = self.limits
        lims = own.acc_lim_x, own.acc_lim_y, own.acc_lim_theta
        x, y, turn = (
            math.copysign(max(abs(now) - acc * self._period, 0.0), now)
            for now, acc in zip(velocity, lims, strict=True)
        )
        return x, y, turn

    def _turn(self, left: float, now: float) -> float:
        """Return the turning rate for the remaining angle."""
        own = self.limits
        rate = min(own.max_vel_theta, max(own.min_vel_theta, abs(left)))
        step = own.acc_lim_theta * self._period
        rate = min(max(rate, abs(now) - step), abs(now) + step)
        rate = min(math.sqrt(2.0 * own.acc_lim_theta * abs(left)), rate)
        rate = min(own.max_vel_theta, max(own.min_vel_theta, rate))
        return math.copysign(rate, left)
