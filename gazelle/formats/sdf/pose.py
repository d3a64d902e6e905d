"""``<pose>`` elements: six numbers, or a quaternion, in radians or degrees."""

from __future__ import annotations

import math

from gazelle.description import Parameters, Pose
from gazelle.errors import did_you_mean
from gazelle.formats import values

QUATERNION = "gazelle:quaternion"
"""Attribute that holds the rotation to the last bit beside angles that do not."""

_FORMATS = ("euler_rpy", "quat_xyzw")
_IDENTITY = Pose()
_ROUNDED = 1e-9


def read_pose(node: Parameters | None) -> Pose:
    """Read the pose as written, relative to whatever frame it names.

    Raises:
        FormatError: It does not hold the numbers of its ``rotation_format``.
    """
    if node is None or not node.text:
        return _IDENTITY
    if _is_quaternion(node):
        n = _finite(node, values.parse_reals(node, node.text, "<pose>", 7))
        return Pose.from_quaternion(n[:3], n[3:])
    x, y, z, roll, pitch, yaw = _finite(node, values.parse_reals(node, node.text, "<pose>", 6))
    if _in_degrees(node):
        roll, pitch, yaw = math.radians(roll), math.radians(pitch), math.radians(yaw)
    return _exact(node, Pose(x, y, z, roll, pitch, yaw))


def _is_quaternion(node: Parameters) -> bool:
    """Return whether a rotation is written as a quaternion.

    Raises:
        FormatError: There is no such ``rotation_format``, or the quaternion is given in degrees.
    """
    name = node.attributes.get("rotation_format") or _FORMATS[0]
    if name not in _FORMATS:
        hint = did_you_mean(name, _FORMATS)
        raise values.fail(node, f"unknown rotation_format '{name}' of a <pose>", hint=hint)
    if name == _FORMATS[0]:
        return False
    if _in_degrees(node):
        raise values.fail(node, "a <pose> with a quaternion cannot be in degrees")
    return True


def _in_degrees(node: Parameters) -> bool:
    degrees = node.attributes.get("degrees", "")
    return bool(degrees) and values.parse_flag(node, degrees, "attribute 'degrees'")


def _exact(node: Parameters, pose: Pose) -> Pose:
    """Return the pose with its quaternion as saved, unless the angles were changed since."""
    saved = node.attributes.get(QUATERNION, "")
    if not saved:
        return pose
    quaternion = _finite(node, values.parse_reals(node, saved, f"attribute '{QUATERNION}'", 4))
    exact = Pose.from_quaternion(pose.position, quaternion)
    return exact if exact.is_close(pose, position=_ROUNDED, angle=_ROUNDED) else pose


def _finite(node: Parameters, numbers: tuple[float, ...]) -> tuple[float, ...]:
    if not all(map(math.isfinite, numbers)):
        raise values.fail(node, f"a pose must be finite, found '{node.text}'")
    return numbers


def frame_of(node: Parameters | None) -> str:
    """Return the frame that a pose is written in; empty for the usual one."""
    if node is None:
        return ""
    return node.attributes.get("relative_to", "") or node.attributes.get("frame", "")
