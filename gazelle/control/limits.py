"""Limits of joints: what URDF and parameters say, and how commands are held within them.

The rules are those of ros_control's joint_limits_interface.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from gazelle.control.limit_law import LimitLaw
from gazelle.control.parameters import ControllerParameters
from gazelle.description import Joint, SafetyController


@dataclass(frozen=True, slots=True)
class JointLimits:
    """Hard limits of a joint; infinite where there are none.

    Attributes:
        lower: Of the position [m or rad].
        upper: Likewise.
        velocity: [m/s or rad/s].
        acceleration: [m/s² or rad/s²].
        effort: [N or N m].
        soft: Soft limits, or None.
    """

    lower: float = -math.inf
    upper: float = math.inf
    velocity: float = math.inf
    acceleration: float = math.inf
    effort: float = math.inf
    soft: SafetyController | None = None

    @property
    def any(self) -> bool:
        """True if there is any limit."""
        values = (self.upper, -self.lower, self.velocity, self.acceleration, self.effort)
        return any(math.isfinite(value) for value in values)

    @classmethod
    def of_joint(cls, joint: Joint) -> JointLimits:
        """Return the limits in a description; positions count for revolute and prismatic joints only."""
        if not joint.axes:
            return cls()
        axis = joint.axes[0]
        bounded = joint.type in ("revolute", "prismatic")
        return cls(
            lower=axis.lower if bounded else -math.inf,
            upper=axis.upper if bounded else math.inf,
            velocity=axis.velocity,
            effort=axis.effort,
            soft=joint.safety,
        )

    def overridden(
        self, parameters: Mapping[str, Any], place: str, *, soft: bool = False
    ) -> JointLimits:
        """Return the limits with the parameters of ``joint_limits/JOINT``.

        Each ``has_X`` that is true needs its values, and false takes a limit away.

        Args:
            parameters: The parameters.
            place: Place of the parameters, for messages.
            soft: Whether soft limits are read, too; Gazebo's plugin does not.

        Raises:
            ControlError: A value is of a wrong type.
        """
        values = ControllerParameters(parameters, place)
        found = _with_positions(self, values)
        for name in ("velocity", "acceleration", "effort"):
            has = f"has_{name}_limits"
            if has not in values:
                continue
            if not values.flag(has):
                found = _with(found, name, math.inf)
            elif f"max_{name}" in values:
                found = _with(found, name, values.number(f"max_{name}"))
        return _with_soft(found, values) if soft else found


def _with(limits: JointLimits, name: str, value: float) -> JointLimits:
    if name == "velocity":
        return replace(limits, velocity=value)
    if name == "acceleration":
        return replace(limits, acceleration=value)
    return replace(limits, effort=value)


def _with_positions(limits: JointLimits, values: ControllerParameters) -> JointLimits:
    """Return limits with the given position limits; a continuous joint has none."""
    if "has_position_limits" not in values:
        return limits
    if not values.flag("has_position_limits"):
        return replace(limits, lower=-math.inf, upper=math.inf)
    if "min_position" not in values or "max_position" not in values:
        return limits
    return replace(limits, lower=values.number("min_position"), upper=values.number("max_position"))


def _with_soft(limits: JointLimits, values: ControllerParameters) -> JointLimits:
    names = ("k_velocity", "k_position", "soft_lower_limit", "soft_upper_limit")
    if "has_soft_limits" in values and not values.flag("has_soft_limits"):
        return replace(limits, soft=None)
    if "has_soft_limits" not in values or not all(name in values for name in names):
        return limits
    return replace(limits, soft=SafetyController(*(values.number(name) for name in names)))


def limit_law(limits: Sequence[JointLimits]) -> LimitLaw:
    """Return the limits of several joints, for native code."""
    soft = [each.soft or SafetyController(0.0) for each in limits]
    columns: dict[str, Any] = {
        name: [getattr(each, name) for each in limits]
        for name in ("lower", "upper", "velocity", "acceleration", "effort")
    }
    columns |= {
        "k_position": [each.k_position for each in soft],
        "k_velocity": [each.k_velocity for each in soft],
        "soft_lower": [each.soft_lower_limit for each in soft],
        "soft_upper": [each.soft_upper_limit for each in soft],
        "soft": [each.soft is not None for each in limits],
        "bounded": [
            each.soft is not None and (math.isfinite(each.lower) or math.isfinite(each.upper))
            for each in limits
        ],
    }
    return LimitLaw(columns)
