"""Links that hang on joints, put somewhere: the joint takes the part of the pose that it allows.

A hinge takes the turn about its axis, a slide the way along it, as the joint's parent stands.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from gazelle.array_types import Floats, Worlds
from gazelle.description import Joint, Model, Pose, World
from gazelle.engines.free_links import with_free_links
from gazelle.engines.motion import Motion, Placement
from gazelle.engines.state import JointRow, JointRows, LinkRow, LinkRows
from gazelle.engines.table import Table
from gazelle.kinematics.tree import TreeLink, tree_of
from gazelle.rotations import conjugate, cross, multiply, rotate


@dataclass(frozen=True, slots=True)
class _Holder:
    """The joint that a link hangs on.

    Attributes:
        body: The link that the joint holds.
        joint: The joint.
        offset: The link in the frame of ``body``, to which fixed joints hold it.
    """

    body: TreeLink
    joint: Joint
    offset: Pose


class HangingLinks:
    """Moves links by the joints that they hang on, in any engine.

    Args:
        world: Returns the world that runs.
        links: Links of all models.
        joints: Joints of all models.
        fixed: Types of joints that do not move.
    """

    def __init__(
        self,
        world: Callable[[], World],
        links: Table[LinkRow, LinkRows],
        joints: Table[JointRow, JointRows],
        fixed: frozenset[str] = frozenset({"fixed"}),
    ) -> None:
        self._world, self._links, self._joints, self._fixed = world, links, joints, fixed

    def place(self, link: str, goal: Placement, worlds: Worlds | None) -> str:
        """Move the joint that a link hangs on towards a pose of the link in the world.

        Returns:
            The joint's scoped name; empty for a link that hangs on none that can move.
        """
        holder = self._holder(link)
        if holder is None:
            return ""
        joint = holder.joint
        body = _times(goal, holder.offset.inverse())
        if joint.type == "floating":
            position = np.concatenate((body.position, body.quaternion), axis=1)
        else:
            frame = self._frame(holder, goal, worlds)
            position = _positions(joint, _times(body, joint.pose).relative_to(frame))
        self._joints[holder.body.joint_name].set_position(position, worlds)
        return holder.body.joint_name

    def move(self, link: str, goal: Motion, worlds: Worlds | None) -> bool:
        """Set the speed of the joint that a link hangs on, to suit a velocity of the link.

        Returns:
            False for a link that hangs on no joint that can move.
        """
        holder = self._holder(link)
        if holder is None:
            return False
        here = self._links[link].placement(worlds)
        linear, angular = goal.linear, goal.angular
        if holder.body.parent is not None:
            above = self._links[holder.body.parent].placement(worlds)
            parent = self._links[holder.body.parent].motion(worlds)
            linear = linear - parent.linear
            linear = linear - cross(parent.angular, here.position - above.position)
            angular = angular - parent.angular
        body = _times(here, holder.offset.inverse())
        if holder.joint.type in ("ball", "floating"):
            turned = rotate(conjugate(body.quaternion), angular)
            free = np.concatenate((linear, turned), axis=1)
            rates = turned if holder.joint.type == "ball" else free
        else:
            frame = self._frame(holder, here, worlds)
            child = _times(body, holder.joint.pose)
            arm = child.position - here.position
            rates = _rates(holder.joint, frame, child, Motion(linear, angular), arm)
        self._joints[holder.body.joint_name].set_velocity(rates, worlds)
        return True

    def _holder(self, link: str) -> _Holder | None:
        """Return the nearest joint above a link that can move; None if there is none."""
        root = link.partition("::")[0]
        model: Model = next(each for each in self._world().models if each.name == root)
        bodies = {body.name: body for body in tree_of(with_free_links(model)).bodies}
        body, offset = bodies[link], Pose()
        while body.joint is not None and body.joint.type in self._fixed:
            if body.parent is None:
                return None
            body, offset = bodies[body.parent], body.pose * offset
        return None if body.joint is None else _Holder(body, body.joint, offset)

    def _frame(self, holder: _Holder, like: Placement, worlds: Worlds | None) -> Placement:
        """Return the joint's frame on its parent's side, in the world."""
        local = holder.body.pose * holder.joint.pose
        if holder.body.parent is not None:
            return _times(self._links[holder.body.parent].placement(worlds), local)
        count = len(like.position)
        return Placement(
            np.tile(np.array(local.position), (count, 1)),
            np.tile(np.array(local.quaternion), (count, 1)),
        )


def _times(place: Placement, pose: Pose) -> Placement:
    """Return poses given in the frames of some placements in the frame of those."""
    at, turn = np.array(pose.position), np.array(pose.quaternion)
    return Placement(
        place.position + rotate(place.quaternion, at[None]), multiply(place.quaternion, turn[None])
    )


def _positions(joint: Joint, moved: Placement) -> Floats:
    """Return the positions of a joint that come nearest to a motion, shape (n, axes).

    Args:
        joint: The joint.
        moved: The joint's frame on the child's side in that on the parent's.
    """
    if joint.type == "ball":
        turn = np.array(joint.pose.quaternion)[None]
        return np.asarray(multiply(multiply(turn, moved.quaternion), conjugate(turn)))
    axes = [np.array(axis.xyz) for axis in joint.axes]
    if joint.type == "prismatic":
        return np.asarray(moved.position @ axes[0][:, None])
    if joint.type in ("universal", "revolute2"):
        first = _angle(axes[0], axes[1], rotate(moved.quaternion, axes[1][None]))
        rest = multiply(_about(axes[0], -first), moved.quaternion)
        angles = [first, _twist(axes[1], rest)]
    else:
        angles = [_twist(axes[0], moved.quaternion)]
    turned = np.stack([_within(joint, i, angle) for i, angle in enumerate(angles)], axis=1)
    if joint.type == "planar":
        return np.concatenate((moved.position @ across(axes[0]).T, turned), axis=1)
    if joint.type == "screw":
        return np.concatenate((turned, turned * -1.0 / joint.thread_pitch), axis=1)
    return turned


def _rates(joint: Joint, frame: Placement, child: Placement, moving: Motion, arm: Floats) -> Floats:
    """Return the speeds of a joint that suit a relative velocity, shape (n, axes).

    Args:
        joint: The joint.
        frame: The joint's frame on the parent's side.
        child: The same on the child's side.
        moving: The link's velocity as the parent sees it, in the world frame.
        arm: From the link's origin to that of ``child`` [m], in the world frame.
    """
    linear, angular = moving.linear, moving.angular
    axes = [np.array(axis.xyz)[None] for axis in joint.axes]
    along = rotate(frame.quaternion, axes[0])
    if joint.type == "prismatic":
        return np.asarray(np.sum(linear * along, axis=1, keepdims=True))
    if joint.type in ("universal", "revolute2"):
        both = np.stack((along, rotate(child.quaternion, axes[1])), axis=2)
        return np.asarray((np.linalg.pinv(both) @ angular[:, :, None])[:, :, 0])
    turning = np.sum(angular * along, axis=1, keepdims=True)
    if joint.type == "planar":
        linear = linear + cross(along * turning, arm)
        ways = [rotate(frame.quaternion, way[None]) for way in across(axes[0][0])]
        return np.concatenate(
            [*(np.sum(linear * way, axis=1, keepdims=True) for way in ways), turning], axis=1
        )
    if joint.type == "screw":
        return np.concatenate((turning, turning * -1.0 / joint.thread_pitch), axis=1)
    return np.asarray(turning)


def across(axis: Floats) -> Floats:
    """Return two unit vectors that make a right-handed frame with a unit vector, shape (2, 3)."""
    helper = (1.0, 0.0, 0.0) if abs(axis[0]) < 0.9 else (0.0, 1.0, 0.0)
    first = np.cross(helper, axis)
    first /= np.linalg.norm(first)
    return np.stack((first, np.cross(axis, first)))


def _about(axis: Floats, angle: Floats) -> Floats:
    half = angle[:, None] / 2.0
    return np.concatenate((np.sin(half) * axis, np.cos(half)), axis=1)


def _twist(axis: Floats, turned: Floats) -> Floats:
    """Return by how much a rotation turns about an axis, in (-pi, pi] [rad], shape (n,)."""
    angle = 2.0 * np.arctan2(turned[:, :3] @ axis, turned[:, 3])
    return np.asarray(angle - 2.0 * math.pi * np.ceil((angle - math.pi) / (2.0 * math.pi)))


def _angle(axis: Floats, start: Floats, end: Floats) -> Floats:
    """Return the angle about an axis from one direction to others [rad], shape (n,)."""
    side = np.cross(axis, start)
    return np.arctan2(end @ side, end @ np.cross(side, axis))


def _within(joint: Joint, index: int, angle: Floats) -> Floats:
    """Return the turn that means the same and is least out of the joint's limits [rad]."""
    axis = joint.axes[index]
    if joint.type == "continuous":
        return angle
    turns = angle[:, None] + 2.0 * math.pi * np.array([0.0, -1.0, 1.0])
    beyond = np.maximum(np.maximum(axis.lower - turns, turns - axis.upper), 0.0)
    return np.asarray(turns[np.arange(len(angle)), np.argmin(beyond, axis=1)])
