"""Joints, segments, chains and trees of segments."""
# ruff: noqa: N802 - the names are KDL's

from __future__ import annotations

from typing import Any

from gazelle_ros.compat.PyKDL.frame import Frame
from gazelle_ros.compat.PyKDL.motion import Twist
from gazelle_ros.compat.PyKDL.rotation import Rotation
from gazelle_ros.compat.PyKDL.vector import Vector

_AXES = {"X": (1, 0, 0), "Y": (0, 1, 0), "Z": (0, 0, 1)}


class Joint:
    """A joint: ``Joint([name,] type)`` or ``Joint([name,] origin, axis, type)``."""

    RotAxis, RotX, RotY, RotZ, TransAxis, TransX, TransY, TransZ, Fixed = (
        "RotAxis", "RotX", "RotY", "RotZ", "TransAxis", "TransX", "TransY", "TransZ", "Fixed",
    )  # fmt: skip

    def __init__(self, *values: Any) -> None:
        rest = list(values)
        named = rest and isinstance(rest[0], str) and (rest[0] not in vars(Joint) or len(rest) > 1)
        self._name = rest.pop(0) if named else "NoName"
        places = [rest.pop(0) for _ in range(2) if rest and isinstance(rest[0], Vector)]
        kind = rest[0] if rest else Joint.Fixed
        if kind not in vars(Joint):
            raise TypeError(f"a joint has a type such as Joint.RotZ, not {kind!r}")
        self._kind = kind
        own = Vector(*_AXES.get(kind[-1], (0, 0, 0)))
        self._origin: Vector = places[0] if len(places) == 2 else Vector()
        self._axis: Vector = Vector(places[1] if len(places) == 2 else own)
        self._axis.Normalize()

    def getName(self) -> str:
        """Return its name."""
        return self._name

    def getType(self) -> str:
        """Return its type."""
        return self._kind

    getTypeName = getType  # noqa: N815

    def JointAxis(self) -> Vector:
        """Return its axis."""
        return Vector(self._axis)

    def JointOrigin(self) -> Vector:
        """Return a point of its axis."""
        return Vector(self._origin)

    def pose(self, q: float) -> Frame:
        """Return the frame behind it at a position [rad or m]."""
        if self._kind.startswith("Rot"):
            return Frame(Rotation.Rot2(self._axis, q), self._origin)
        return Frame(self._origin + self._axis * q)

    def twist(self, qdot: float) -> Twist:
        """Return its motion at a speed [rad/s or m/s]."""
        moved = self._axis * qdot
        return Twist(Vector(), moved) if self._kind.startswith("Rot") else Twist(moved, Vector())


class Segment:
    """A joint and the frame at the end of what it moves: ``Segment([name,] joint, tip)``."""

    def __init__(self, *values: Any) -> None:
        rest = list(values)
        self._name = rest.pop(0) if rest and isinstance(rest[0], str) else "NoName"
        self._joint = rest.pop(0) if rest else Joint(Joint.Fixed)
        tip = rest.pop(0) if rest else Frame()
        self._tip = self._joint.pose(0.0).Inverse() * tip

    def getName(self) -> str:
        """Return its name."""
        return self._name

    def getJoint(self) -> Joint:
        """Return its joint."""
        return self._joint

    def getFrameToTip(self) -> Frame:
        """Return the frame of its end at position 0."""
        frame: Frame = self._joint.pose(0.0) * self._tip
        return frame

    def pose(self, q: float) -> Frame:
        """Return the frame of its end at a position of its joint [rad or m]."""
        frame: Frame = self._joint.pose(q) * self._tip
        return frame

    def moves(self) -> bool:
        """Return whether its joint can move."""
        return self._joint.getType() != Joint.Fixed


class Chain:
    """Segments one after the other."""

    def __init__(self, other: Chain | None = None) -> None:
        self.segments: list[Segment] = list(other.segments) if other is not None else []

    def addSegment(self, segment: Segment) -> None:
        """Add a segment at the end."""
        self.segments.append(segment)

    def addChain(self, chain: Chain) -> None:
        """Add all segments of another at the end."""
        self.segments += chain.segments

    def getNrOfJoints(self) -> int:
        """Return how many joints can move."""
        return sum(segment.moves() for segment in self.segments)

    def getNrOfSegments(self) -> int:
        """Return how many segments there are."""
        return len(self.segments)

    def getSegment(self, nr: int) -> Segment:
        """Return a segment."""
        return self.segments[nr]


class Tree:
    """Segments, each on another or on the root."""

    def __init__(self, root_name: str = "root") -> None:
        self._root = root_name
        self._segments: dict[str, tuple[Segment, str]] = {}

    def addSegment(self, segment: Segment, hook_name: str) -> bool:
        """Add a segment to an existing one; return whether that was possible."""
        name = segment.getName()
        known = hook_name == self._root or hook_name in self._segments
        if not known or name in self._segments:
            return False
        self._segments[name] = (segment, hook_name)
        return True

    def getNrOfJoints(self) -> int:
        """Return how many joints can move."""
        return sum(segment.moves() for segment, _ in self._segments.values())

    def getNrOfSegments(self) -> int:
        """Return how many segments there are."""
        return len(self._segments)

    def getChain(self, chain_root: str, chain_tip: str) -> Chain:
        """Return the segments from one to another.

        Raises:
            ValueError: The root is not above the tip.
        """
        found, name = [], chain_tip
        while name != chain_root:
            if name not in self._segments:
                raise ValueError(f"there is no chain from '{chain_root}' to '{chain_tip}'")
            segment, name = self._segments[name]
            found.append(segment)
        chain = Chain()
        chain.segments = found[::-1]
        return chain
