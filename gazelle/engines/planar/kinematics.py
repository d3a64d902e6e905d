"""Forward kinematics of a model: poses of links in the model's frame."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats
from gazelle.description import Joint, Link, Model, Pose
from gazelle.engines.planar.wheels import Wheel, wheel_of
from gazelle.engines.tree import TreeLink, tree_of
from gazelle.rotations import cross, multiply, rotate

Place = tuple[Floats, Floats]

_MOVING = {"revolute", "continuous", "prismatic", "screw", "universal", "revolute2"}

FROZEN = frozenset({"ball", "fixed", "floating", "planar", "screw"})
"""Joints that hold a link as it is when that is put somewhere: a screw turns only by itself."""


@dataclass(frozen=True, slots=True)
class Hinge:
    """A joint that can move.

    Attributes:
        name: Scoped name.
        joint: What it is.
        column: Of its first axis among those of its model.
    """

    name: str
    joint: Joint
    column: int

    @property
    def is_sliding(self) -> bool:
        """True if it slides instead of turning."""
        return self.joint.type == "prismatic"


@dataclass(frozen=True, slots=True)
class PlanarLink:
    """A link in its model.

    Attributes:
        link: What it is.
        parent: Scoped name of the link it hangs on; None for the model itself.
        pose: In the parent's frame, or the model's, with joints at zero.
        hinge: The joint it hangs by, if that can move.
        rest: Pose in the model's frame with all joints at zero.
        fixed: Whether no joint between it and the model can move.
    """

    link: Link
    parent: str | None
    pose: Pose
    hinge: Hinge | None
    rest: Pose
    fixed: bool


@dataclass(frozen=True, slots=True)
class Skeleton:
    """All links of a model.

    Attributes:
        bones: By scoped name, parents first.
        hinges: By scoped name.
        wheels: Joints that turn something round about a level axis.
        held: Whether a joint holds the model to the world.
        width: Number of axes of all hinges.
    """

    bones: Mapping[str, PlanarLink]
    hinges: Mapping[str, Hinge]
    wheels: Mapping[str, Wheel]
    held: bool
    width: int

    def place(self, name: str, angles: Floats) -> Place:
        """Return the pose of a link in the model's frame: positions (n, 3), quaternions (n, 4).

        Args:
            name: Scoped name of the link.
            angles: Of all hinges, shape (n, width).
        """
        bone, count = self.bones[name], len(angles)
        if bone.fixed:
            return (
                np.tile(bone.rest.position, (count, 1)),
                np.tile(bone.rest.quaternion, (count, 1)),
            )
        here = np.tile(bone.pose.position, (count, 1)), np.tile(bone.pose.quaternion, (count, 1))
        if bone.hinge is not None:
            here = _compose(here, _moved(bone.hinge, angles))
        return here if bone.parent is None else _compose(self.place(bone.parent, angles), here)

    def columns_of(self, name: str) -> NDArray[np.intp]:
        """Return columns of the hinges that a link hangs on, shape (n,); none if it is fixed."""
        found: list[int] = []
        above: str | None = name
        while above is not None:
            bone = self.bones[above]
            if bone.hinge is not None:
                first = bone.hinge.column
                found += range(first, first + len(bone.hinge.joint.axes))
            above = bone.parent
        return np.array(sorted(found), np.intp)

    def motion(self, name: str, angles: Floats, rates: Floats) -> Place:
        """Return the velocity of a link in the model's frame: linear (n, 3) and angular (n, 3)."""
        bone, count = self.bones[name], len(angles)
        linear, angular = np.zeros((count, 3)), np.zeros((count, 3))
        if bone.fixed:
            return linear, angular
        end = self.place(name, angles)[0]
        while bone is not None:
            if bone.hinge is not None:
                at, turned = _compose(
                    self.place(name, angles), _placed(bone.hinge.joint.pose, count)
                )
                for number, axis in enumerate(bone.hinge.joint.axes):
                    way = rotate(turned, np.asarray(axis.xyz))
                    rate = rates[:, [bone.hinge.column + number]]
                    if bone.hinge.is_sliding:
                        linear += rate * way
                    else:
                        angular += rate * way
                        linear += cross(rate * way, end - at)
            if bone.parent is None:
                break
            name = bone.parent
            bone = self.bones[name]
        return linear, angular


def skeleton_of(model: Model, tilt: Pose, *, kinematic: bool = False) -> Skeleton:
    """Return the links and joints of a model.

    Args:
        model: What it is.
        tilt: How its frame leans in the frame that moves in the plane.
        kinematic: Whether joints are frozen, as those of a static model are.

    Raises:
        EngineError: A joint names a link that is not there.
    """
    bones: dict[str, PlanarLink] = {}
    hinges: dict[str, Hinge] = {}
    wheels: dict[str, Wheel] = {}
    held, width = False, 0
    back = model.pose.inverse()
    for body in tree_of(model, kinematic=kinematic).bodies:
        hinge = _hinge_of(body, width)
        above = None if body.parent is None else bones[body.parent]
        pose = back * body.pose if above is None else body.pose
        rest = pose if above is None else above.rest * pose
        fixed = hinge is None and (above is None or above.fixed)
        held = held or (above is None and body.joint is not None)
        bones[body.name] = PlanarLink(body.link, body.parent, pose, hinge, rest, fixed)
        if hinge is None:
            continue
        hinges[hinge.name] = hinge
        width += len(hinge.joint.axes)
        if len(hinge.joint.axes) == 1 and not hinge.is_sliding:
            leaning = tilt * rest
            axis = (leaning * hinge.joint.pose).rotate(hinge.joint.axes[0].xyz)
            wheel = wheel_of(hinge.name, body.link, leaning, axis)
            if wheel is not None:
                wheels[hinge.name] = wheel
    return Skeleton(bones, hinges, wheels, held, width)


def _hinge_of(body: TreeLink, column: int) -> Hinge | None:
    if body.joint is None or body.joint.type not in _MOVING or not body.joint.axes:
        return None
    return Hinge(body.joint_name, body.joint, column)


def _moved(hinge: Hinge, angles: Floats) -> Place:
    """Return the displacement of a hinge's link, in the link's frame at zero."""
    count, frame = len(angles), hinge.joint.pose
    moved = _placed(frame, count)
    for number, axis in enumerate(hinge.joint.axes):
        value = angles[:, [hinge.column + number]]
        way = np.asarray(axis.xyz)
        if hinge.is_sliding:
            step = value * way, np.tile((0.0, 0.0, 0.0, 1.0), (count, 1))
        else:
            turn = np.concatenate((np.sin(value / 2.0) * way, np.cos(value / 2.0)), axis=1)
            step = np.zeros((count, 3)), turn
        moved = _compose(moved, step)
    return _compose(moved, _placed(frame.inverse(), count))


def _placed(pose: Pose, count: int) -> Place:
    return np.tile(pose.position, (count, 1)), np.tile(pose.quaternion, (count, 1))


def _compose(a: Place, b: Place) -> Place:
    return a[0] + rotate(a[1], b[0]), multiply(a[1], b[1])
