"""``<joint>`` of URDF."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import get_args

from gazelle.description import (
    JointAxis,
    JointType,
    Mimic,
    Parameters,
    Pose,
    SafetyController,
)
from gazelle.errors import did_you_mean
from gazelle.formats import values
from gazelle.formats.axis import direction
from gazelle.formats.reading import Reading
from gazelle.formats.urdf.elements import read_origin

_TYPES: tuple[JointType, ...] = tuple(
    kind
    for kind in get_args(JointType)
    if kind in {"revolute", "continuous", "prismatic", "fixed", "floating", "planar"}
)
_LIMITED = {"revolute", "prismatic"}
_FREE = {"fixed", "floating"}


@dataclass(frozen=True, slots=True)
class UrdfJoint:
    """A joint as written: ``origin`` is its frame, and the child link's, in the parent."""

    name: str
    type: JointType
    parent: str
    child: str
    origin: Pose
    axis: JointAxis | None
    safety: SafetyController | None
    node: Parameters


def read_joint(node: Parameters, reading: Reading) -> UrdfJoint:
    """Read one joint.

    Raises:
        FormatError: Something that a joint needs is missing or wrong.
    """
    kind = _type(node)
    return UrdfJoint(
        name=values.attribute(node, "name"),
        type=kind,
        parent=_link(node, "parent"),
        child=_link(node, "child"),
        origin=read_origin(node.find("origin")),
        axis=None if kind in _FREE else read_axis(node, kind, reading),
        safety=read_safety(node.find("safety_controller")),
        node=node,
    )


def _type(node: Parameters) -> JointType:
    text = values.attribute(node, "type")
    for known in _TYPES:
        if text == known:
            return known
    raise values.fail(node, f"unknown joint type '{text}'", hint=did_you_mean(text, _TYPES))


def _link(node: Parameters, tag: str) -> str:
    element = node.find(tag)
    if element is None:
        raise values.fail(node, f"a <joint> needs a <{tag}>")
    return values.attribute(element, "link")


def read_axis(node: Parameters, kind: JointType, reading: Reading) -> JointAxis:
    """Read the axis with limits, dynamics and mimic.

    Raises:
        FormatError: A revolute or prismatic joint has no limits.
    """
    axis = node.find("axis")
    xyz = (1.0, 0.0, 0.0) if axis is None else values.attribute_vector(axis, "xyz", (1.0, 0.0, 0.0))
    limit = node.find("limit")
    if limit is None and kind in _LIMITED:
        raise values.fail(
            node,
            f"a {kind} joint needs a <limit>",
            hint="add <limit lower upper effort velocity>"
            + (", or make the joint continuous" if kind == "revolute" else ""),
        )
    dynamics = node.find("dynamics")
    lower, upper = _travel(limit, kind, reading)
    return JointAxis(
        xyz=direction(xyz, axis or node, reading),
        lower=lower,
        upper=upper,
        effort=_endless(limit, "effort", reading),
        velocity=_endless(limit, "velocity", reading),
        damping=0.0 if dynamics is None else values.attribute_real(dynamics, "damping", 0.0),
        friction=0.0 if dynamics is None else values.attribute_real(dynamics, "friction", 0.0),
        mimic=_mimic(node.find("mimic")),
    )


def _travel(limit: Parameters | None, kind: JointType, reading: Reading) -> tuple[float, float]:
    if limit is None or kind not in _LIMITED:
        return (-math.inf, math.inf)
    lower, upper = (_reach(values.attribute_real(limit, name, 0.0)) for name in ("lower", "upper"))
    if lower > upper:
        reading.fault(
            f"the lower limit {lower:g} is greater than the upper {upper:g}: they were swapped",
            limit,
        )
        return (upper, lower)
    return (lower, upper)


def _reach(value: float) -> float:
    return math.copysign(math.inf, value) if abs(value) >= values.INFINITE else value


def _endless(limit: Parameters | None, name: str, reading: Reading) -> float:
    if limit is None:
        return math.inf
    value = _reach(values.attribute_real(limit, name))
    if value >= 0.0:
        return value
    reading.note(
        f"the {name} limit is below zero, {value:g}: no limit was taken",
        limit,
        "give the greatest magnitude, which holds in both directions",
    )
    return math.inf


def _mimic(node: Parameters | None) -> Mimic | None:
    if node is None:
        return None
    return Mimic(
        joint=values.attribute(node, "joint"),
        multiplier=values.attribute_real(node, "multiplier", 1.0),
        offset=values.attribute_real(node, "offset", 0.0),
    )


def read_safety(node: Parameters | None) -> SafetyController | None:
    """Read ``<safety_controller>``."""
    if node is None:
        return None
    return SafetyController(
        k_velocity=values.attribute_real(node, "k_velocity"),
        k_position=values.attribute_real(node, "k_position", 0.0),
        soft_lower_limit=values.attribute_real(node, "soft_lower_limit", 0.0),
        soft_upper_limit=values.attribute_real(node, "soft_upper_limit", 0.0),
    )
