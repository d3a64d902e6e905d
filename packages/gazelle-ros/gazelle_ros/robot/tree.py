"""The joints of a URDF, as far as frames need them (http://wiki.ros.org/urdf/XML/joint)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from gazelle_ros.base.errors import RosError
from gazelle_ros.base.real_numbers import finite
from gazelle_ros.base.rotations import IDENTITY, ORIGIN, Quaternion, Vector, add, multiply, rotate
from gazelle_ros.launch.document import Element, parse_element
from gazelle_ros.launch.errors import LaunchError

_TURNING = frozenset({"revolute", "continuous"})
_KINDS = _TURNING | {"prismatic", "fixed", "floating", "planar"}
MOVABLE = _TURNING | {"prismatic"}
"""Types of joints that one number places."""


@dataclass(frozen=True, slots=True)
class TreeMimic:
    """A joint that follows another: `multiplier` times its position, plus `offset`."""

    joint: str
    multiplier: float = 1.0
    offset: float = 0.0


@dataclass(frozen=True, slots=True)
class TreeJoint:
    """A joint between two links.

    Attributes:
        name: Of the joint.
        kind: ``revolute``, ``continuous``, ``prismatic``, ``fixed``, ``floating`` or ``planar``.
        parent: Name of the link it is on.
        child: Name of the link it moves.
        translation: Of the child in the parent, at position 0 [m].
        rotation: Of the child in the parent, at position 0 (x, y, z, w).
        axis: Unit vector in the child's frame.
        lower: Least position [rad or m]; None without limits.
        upper: Largest position [rad or m]; None without limits.
        mimic: Mimicked joint; None if it moves by itself.

    Raises:
        RosError: A number is not finite.
    """

    name: str
    kind: str
    parent: str
    child: str
    translation: Vector = ORIGIN
    rotation: Quaternion = IDENTITY
    axis: Vector = (1.0, 0.0, 0.0)
    lower: float | None = None
    upper: float | None = None
    mimic: TreeMimic | None = None
    soft_lower: float | None = None
    soft_upper: float | None = None

    def __post_init__(self) -> None:
        limits = (self.lower, self.upper, self.soft_lower, self.soft_upper)
        rows = (self.translation, 3), (self.rotation, 4), (self.axis, 3)
        numbers = [each for each in limits if each is not None]
        if not all(_is_row(*each) for each in (*rows, (numbers, len(numbers)))):
            raise RosError(f"the joint '{self.name}' has numbers that are not finite, or missing")

    def placed(self, position: float) -> tuple[Vector, Quaternion]:
        """Return translation and rotation of the child in the parent at a position [rad or m].

        With a position of NaN they hold NaN.
        """
        if self.kind in _TURNING:
            sine, cosine = math.sin(position / 2.0), math.cos(position / 2.0)
            x, y, z = self.axis
            turn = (x * sine, y * sine, z * sine, cosine)
            return self.translation, multiply(self.rotation, turn)
        if self.kind == "prismatic":
            x, y, z = self.axis
            shift = rotate(self.rotation, (x * position, y * position, z * position))
            return add(self.translation, shift), self.rotation
        return self.translation, self.rotation


JointTree = dict[str, TreeJoint]
"""Joints by name, in the order of the file."""


def read_joints(text: str) -> JointTree:
    """Read the joints of a URDF.

    Raises:
        RosError: It is not XML, not a robot, or a joint is malformed.
    """
    try:
        root = parse_element(text.encode(), "robot_description")
    except (LaunchError, UnicodeEncodeError) as error:
        raise RosError(f"the robot description is not XML: {error}") from None
    if root.tag != "robot":
        raise RosError(f"the robot description is a <{root.tag}>, not a <robot>")
    joints: JointTree = {}
    for element in (child for child in root.children if child.tag == "joint"):
        joint = _joint(element)
        if joint.name in joints:
            raise RosError(f"two joints are called '{joint.name}'", line=_line(element))
        joints[joint.name] = joint
    check_mimics(joints)
    return joints


def _joint(element: Element) -> TreeJoint:
    name, kind = element.attributes.get("name", ""), element.attributes.get("type", "")
    parent, child = element.find("parent"), element.find("child")
    if not name or kind not in _KINDS or parent is None or child is None:
        raise RosError(
            f"the joint '{name}' has no name, parent or child, or an unknown type '{kind}'",
            line=_line(element),
        )
    origin = element.find("origin")
    xyz = rpy = ORIGIN
    if origin is not None:
        xyz, rpy = _three(origin, "xyz", ORIGIN), _three(origin, "rpy", ORIGIN)
    axis = element.find("axis")
    limit = element.find("limit")
    bounded = limit is not None and kind in {"revolute", "prismatic"}
    safety = element.find("safety_controller")
    return TreeJoint(
        name,
        kind,
        parent.attributes.get("link", ""),
        child.attributes.get("link", ""),
        xyz,
        _from_angles(rpy),
        _unit(_three(axis, "xyz", (1.0, 0.0, 0.0))) if axis is not None else (1.0, 0.0, 0.0),
        _number(limit, "lower", 0.0) if bounded else None,
        _number(limit, "upper", 0.0) if bounded else None,
        _mimic(element.find("mimic")),
        _soft_limit(safety, "soft_lower_limit"),
        _soft_limit(safety, "soft_upper_limit"),
    )


def _soft_limit(safety: Element | None, key: str) -> float | None:
    given = safety is not None and key in safety.attributes
    return _number(safety, key, 0.0) if given else None


def _mimic(element: Element | None) -> TreeMimic | None:
    if element is None:
        return None
    return TreeMimic(
        element.attributes.get("joint", ""),
        _number(element, "multiplier", 1.0),
        _number(element, "offset", 0.0),
    )


def check_mimics(joints: JointTree) -> None:
    """Check that joints follow others that are there, and none itself.

    Raises:
        RosError: One does not.
    """
    for joint in joints.values():
        seen, each = {joint.name}, joint
        while each.mimic is not None:
            if each.mimic.joint not in joints or each.mimic.joint in seen:
                raise RosError(
                    f"the joint '{each.name}' mimics '{each.mimic.joint}', which is not there, "
                    "or follows it"
                )
            each = joints[each.mimic.joint]
            seen.add(each.name)


def _line(element: Element | None) -> int | None:
    return None if element is None else element.line


def _float(text: str) -> float | None:
    """Return a finite number of a file; None for anything else."""
    try:
        return finite(float(text))
    except ValueError:
        return None


def _number(element: Element | None, key: str, default: float) -> float:
    text = None if element is None else element.attributes.get(key)
    if text is None:
        return default
    number = _float(text)
    if number is None:
        raise RosError(f"{key} is '{text}', not a finite number", line=_line(element))
    return number


def _three(element: Element, key: str, default: Vector) -> Vector:
    text = element.attributes.get(key)
    if text is None:
        return default
    numbers = [_float(word) for word in text.split()]
    three = [number for number in numbers if number is not None]
    if len(three) != 3 or len(numbers) != 3:
        raise RosError(f"{key} is '{text}', not three finite numbers", line=_line(element))
    return (three[0], three[1], three[2])


def _is_row(row: Any, length: int) -> bool:
    """Return whether a value is a row of so many finite numbers."""
    fits = isinstance(row, tuple | list) and len(row) == length
    return fits and all(finite(each) is not None for each in row)


def _unit(axis: Vector) -> Vector:
    norm = math.sqrt(sum(part * part for part in axis)) or 1.0
    return (axis[0] / norm, axis[1] / norm, axis[2] / norm)


def _from_angles(rpy: Vector) -> Quaternion:
    """Return the rotation of turns about fixed axes x, y, z [rad]."""
    result = IDENTITY
    for axis, angle in enumerate(rpy):
        turn = [0.0, 0.0, 0.0, math.cos(angle / 2.0)]
        turn[axis] = math.sin(angle / 2.0)
        result = multiply((turn[0], turn[1], turn[2], turn[3]), result)
    return result


def position_of(joints: JointTree, name: str, positions: dict[str, float]) -> float | None:
    """Return the position of a joint, its own or that of the joint it follows.

    None if not known.
    """
    joint = joints[name]
    if joint.mimic is None:
        return positions.get(name)
    followed = position_of(joints, joint.mimic.joint, positions)
    if followed is None:
        return positions.get(name)
    return followed * joint.mimic.multiplier + joint.mimic.offset
