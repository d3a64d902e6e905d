"""Variables of a robot: one position each, with the limits that plans and trajectories keep."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from gazelle.argument_checks import checked
from gazelle.description import Joint
from gazelle.errors import PlanningError, did_you_mean
from gazelle_ros.base.real_numbers import real

_PARAMETERS = (
    "has_position_limits",
    "min_position",
    "max_position",
    "has_velocity_limits",
    "max_velocity",
    "has_acceleration_limits",
    "max_acceleration",
    "has_jerk_limits",
    "max_jerk",
    "has_effort_limits",
    "max_effort",
    "angle_wraparound",
    "has_soft_limits",
    "k_position",
    "k_velocity",
    "soft_lower_limit",
    "soft_upper_limit",
    "max_deceleration",
    "has_deceleration_limits",
)
"""Of a joint in ``joint_limits.yaml``; soft, effort and jerk limits have no part in planning."""


@checked(PlanningError)
@dataclass(frozen=True, slots=True)
class JointBounds:
    """Limits of one variable.

    Attributes:
        lower: [m or rad].
        upper: [m or rad].
        velocity: Largest speed [m/s or rad/s]; infinite by default.
        acceleration: Largest acceleration [m/s² or rad/s²]; infinite by default.
    """

    lower: float = -math.inf
    upper: float = math.inf
    velocity: float = math.inf
    acceleration: float = math.inf

    def with_parameters(self, entry: Mapping[str, Any], joint: str = "") -> JointBounds:
        """Return these limits with the changes of an entry of MoveIt's ``joint_limits.yaml``.

        Args:
            entry: Such as ``{"has_velocity_limits": True, "max_velocity": 1.0}``; a limit whose
                ``has_...`` is False is none.
            joint: For messages.

        Raises:
            PlanningError: A value is not a number, or a name is unknown.
        """
        for name in entry:
            if name not in _PARAMETERS:
                raise PlanningError(
                    f"'{name}' of joint '{joint}' is not a limit",
                    hint=did_you_mean(name, _PARAMETERS),
                )
        made = self
        position = entry.get("has_position_limits", "min_position" in entry)
        if position:
            made = replace(
                made,
                lower=_number(entry, "min_position", made.lower, joint),
                upper=_number(entry, "max_position", made.upper, joint),
            )
        elif "has_position_limits" in entry:
            made = replace(made, lower=-math.inf, upper=math.inf)
        for kind in ("velocity", "acceleration"):
            name = f"max_{kind}"
            if entry.get(f"has_{kind}_limits", name in entry):
                made = replace(made, **{kind: _number(entry, name, getattr(made, kind), joint)})
            elif f"has_{kind}_limits" in entry:
                made = replace(made, **{kind: math.inf})
        return made


@checked(PlanningError)
@dataclass(frozen=True, slots=True)
class Variable:
    """One position of a robot.

    Attributes:
        name: Of the joint, or ``JOINT/x`` where a joint has several.
        joint: Its joint.
        kind: ``revolute``, ``continuous`` or ``prismatic``.
        bounds: Its limits.
        mimics: Whether it follows another one.
    """

    name: str
    joint: str
    kind: str
    bounds: JointBounds
    mimics: bool = False

    @property
    def endless(self) -> bool:
        """True if it turns without limits, so that a full turn changes nothing."""
        unlimited = self.bounds.lower == -math.inf and self.bounds.upper == math.inf
        return self.kind != "prismatic" and unlimited


def bounds_of(joint: Joint) -> JointBounds:
    """Return the limits of a description; the soft ones where it has them."""
    axis = joint.axes[0]
    lower, upper = axis.lower, axis.upper
    safety = joint.safety
    if safety is not None and (safety.soft_lower_limit, safety.soft_upper_limit) != (0.0, 0.0):
        lower, upper = max(lower, safety.soft_lower_limit), min(upper, safety.soft_upper_limit)
    if joint.type == "continuous":
        lower, upper = -math.inf, math.inf
    velocity = axis.velocity if axis.velocity > 0.0 else math.inf
    return JointBounds(lower, upper, velocity)


def _number(entry: Mapping[str, Any], name: str, default: float, joint: str) -> float:
    value = entry.get(name, default)
    number = real(value)
    if number is None or math.isnan(number):
        raise PlanningError(f"'{name}' of joint '{joint}' must be a number, not {value!r:.60}")
    return number
