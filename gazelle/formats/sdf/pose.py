"""``<pose>`` elements: six numbers, or a quaternion, in radians or degrees."""

from __future__ import annotations

import math

from gazelle.description import Parameters, Pose
from gazelle.formats import values

QUATERNION = "gazelle:quaternion"
"""Attribute that holds the rotation to the last bit beside angles that do not."""

_IDENTITY = Pose()
_ROUNDED = 1e-9


def read_pose(node: Parameters | None) -> Pose:
    """Read the pose as written, relative to whatever frame it names.

    Raises:
        FormatError: It does not hold the numbers of its ``rotation_format``.
    """
    if node is None or not node.text:
        return _IDENTITY
    if node.attributes.get("rotation_format", "euler_rpy") == "quat_xyzw":
        n = _finite(node, values.parse_reals(node, node.text, "<pose>", 7))
        return Pose.from_quaternion(n[:3], n[3:])
    x, y, z, roll, pitch, yaw = _finite(node, values.parse_reals(node, node.text, "<pose>", 6))
    degrees = node.attributes.get("degrees", "")
    if degrees and values.parse_flag(node, degrees, "attribute 'degrees'"):
        roll, pitch, yaw = math.radians(roll), math.radians(pitch), math.radians(yaw)
    return _exact(node, Pose(x, y, z, roll, pitch, yaw))


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
