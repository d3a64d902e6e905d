"""Elements out of values: the opposite of ``gazelle.formats.values``."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from types import MappingProxyType
from typing import Protocol

from gazelle.description import Parameters, Pose, Source
from gazelle.description.pose import Vector3, multiply, rotate
from gazelle.errors import FormatError
from gazelle.formats.sdf.pose import QUATERNION

Value = bool | int | float | str | tuple[float, ...]

ENDLESS = "1e16"
"""Value by which SDF and URDF write "no limit"."""


def element(tag: str, *children: Parameters | None, text: str = "", **names: str) -> Parameters:
    """Return an element; children that are None are left out, and so are empty attributes."""
    attributes = {name: value for name, value in names.items() if value}
    kept = tuple(child for child in children if child is not None)
    return Parameters(tag, text, MappingProxyType(attributes), kept)


def group(tag: str, *children: Parameters | None) -> Parameters | None:
    """Return an element if it has content."""
    return element(tag, *children) if any(child is not None for child in children) else None


def leaf(tag: str, value: Value | None, default: Value | None = None) -> Parameters | None:
    """Return an element that holds a value; None where the value is the default."""
    if value is None or value == default:
        return None
    return element(tag, text=written(value))


def limit(tag: str, value: float, default: float | None = None) -> Parameters | None:
    """Return an element like ``leaf``, for a number that may be infinite."""
    if value == default or not math.isinf(value):
        return leaf(tag, value, default)
    return element(tag, text=endless(value))


def endless(value: float) -> str:
    """Return a number as text; an infinite one becomes a very large one."""
    if not math.isinf(value):
        return written(value)
    return ENDLESS if value > 0 else f"-{ENDLESS}"


def written(value: Value) -> str:
    """Return a value as text that reads as the very same one.

    Raises:
        FormatError: It is, or holds, what is not a number.
    """
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return value
    if isinstance(value, tuple):
        return " ".join(map(_number, value))
    return _number(value)


def _number(value: float) -> str:
    if math.isnan(value):
        raise FormatError("'nan' is not a number and cannot be written")
    if math.isinf(value):
        return "inf" if value > 0 else "-inf"
    if value == int(value) and abs(value) < 1e15:
        return str(int(value))
    return repr(float(value)) if isinstance(value, float) else str(value)


def pose_leaf(pose: Pose, *, always: bool = False) -> Parameters | None:
    """Return ``<pose>`` in angles.

    Where they cost the last digit, with the quaternion beside them.

    SDF 1.9 has a ``rotation_format`` for it, which Gazebo Classic takes for angles; so the
    quaternion stands in an attribute of Gazelle's own namespace.
    """
    if pose == Pose() and not always:
        return None
    if not all(map(math.isfinite, (*pose.position, *pose.quaternion))):
        raise FormatError("a pose must be finite")
    angles = exact_angles(pose)
    if angles is not None:
        return leaf("pose", (*pose.position, *angles))
    angles = angles_of(pose)
    exact = {QUATERNION: written(pose.quaternion)}
    return element("pose", text=written((*pose.position, *angles)), **exact)


def exact_angles(pose: Pose) -> Vector3 | None:
    """Return the shortest roll, pitch and yaw that give this very pose; None if none do."""
    for found in (pose.rpy, angles_of(pose)):
        for digits in (4, 6, 9, 12, 15, 17):
            roll, pitch, yaw = (float(f"{angle:.{digits}g}") for angle in found)
            if Pose(*pose.position, roll, pitch, yaw) == pose:
                return (roll, pitch, yaw)
    return None


def angles_of(pose: Pose) -> Vector3:
    """Return roll, pitch and yaw, precise also where pitch is near a right angle.

    Yaw is ill-defined there, so roll and pitch are taken from what is left of the rotation
    once it is turned back by that yaw: an error of yaw ends in roll, not in the rotation.
    """
    q = pose.quaternion
    ahead = rotate(q, (1.0, 0.0, 0.0))
    yaw = math.atan2(ahead[1], ahead[0])
    q = multiply((0.0, 0.0, -math.sin(yaw / 2), math.cos(yaw / 2)), q)
    roll = 2.0 * math.atan2(q[0], q[3])
    q = multiply(q, (-math.sin(roll / 2), 0.0, 0.0, math.cos(roll / 2)))
    pitch = 2.0 * math.atan2(q[1], q[3])
    return (_within(roll), _within(pitch), yaw)


def _within(angle: float) -> float:
    """Return the angle in [-pi, pi]."""
    return math.remainder(angle, 2.0 * math.pi)


def overlay(base: Parameters, over: Parameters) -> Parameters:
    """Return an element with the values of ``over`` put into ``base``, which keeps its order.

    Children go together by tag, the first of each with the first of the other and so on.
    """
    waiting = list(over.children)
    merged = []
    for child in base.children:
        match = next((other for other in waiting if other.tag == child.tag), None)
        if match is None:
            merged.append(child)
        else:
            waiting = [other for other in waiting if other is not match]
            merged.append(overlay(child, match))
    return replace(
        base,
        text=over.text or base.text,
        attributes=MappingProxyType({**over.attributes, **base.attributes}),
        children=(*waiting, *merged),
    )


class NamedElement(Protocol):
    """A piece of a description that has a name."""

    @property
    def name(self) -> str:
        """Name of the element."""

    @property
    def source(self) -> Source | None:
        """Source location."""


@contextmanager
def inside(tag: str, part: NamedElement) -> Iterator[None]:
    """Add the place to errors raised in it: the part's file, or its name.

    Raises:
        FormatError: The part has no name.
    """
    known = part.source
    if known is None or not known.element:
        known = Source(element=f"{tag}[@name='{part.name}']")
    if not part.name:
        raise FormatError(f"a <{tag}> needs a name", source=known)
    try:
        yield
    except FormatError as error:
        if error.element is not None:
            raise
        raise FormatError(error.message, hint=error.hint, source=known) from None


def distinct(tag: str, parts: Sequence[NamedElement]) -> None:
    """Raise an error for two parts of one name.

    Raises:
        FormatError: Two have one.
    """
    seen: set[str] = set()
    for part in parts:
        if part.name in seen:
            place = Source(element=f"{tag}[@name='{part.name}']")
            raise FormatError(
                f"there are two with the name '{part.name}'", source=part.source or place
            )
        seen.add(part.name)
