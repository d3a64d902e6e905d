"""Forward kinematics of a model: poses of links in the model's frame."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from gazelle.array_types import Floats, Indices
from gazelle.description import Joint, Link, Model, Pose
from gazelle.engines.planar.wheels import Wheel, wheel_of
from gazelle.kinematics.joint_nodes import JointNodes, flat
from gazelle.kinematics.joint_tree import JointTree
from gazelle.kinematics.tree import TreeLink, tree_of
from gazelle.rotations import from_matrices

Place = tuple[Floats, Floats]

_MOVING = frozenset({"revolute", "continuous", "prismatic", "screw", "universal", "revolute2"})

FROZEN = frozenset({"ball", "fixed", "floating", "planar", "screw"})
"""Joints that hold a link as it is when that is put somewhere: a screw turns only by itself."""


@dataclass(frozen=True, slots=True)
class PlanarLink:
    """A link in its model.

    Attributes:
        link: The link of the description.
        node: Index of the axis that it moves with, -1 for the model's frame.
        offset: Pose in the frame of that axis.
        rest: Pose in the model's frame with all joints at zero.
    """

    link: Link
    node: int
    offset: Pose
    rest: Pose

    @property
    def fixed(self) -> bool:
        """True if no joint between it and the model can move."""
        return self.node < 0


class LinkTree:
    """All links of a model.

    Args:
        nodes: Axes of its joints.
        links: Links by scoped name, parents first.
        hinges: Joints that can move, by scoped name.
        wheels: Joints that turn something round about a level axis.
        held: Whether a joint holds the model to the world.

    Attributes:
        width: Number of axes of all joints that can move.
    """

    def __init__(
        self,
        nodes: JointNodes,
        links: Mapping[str, PlanarLink],
        hinges: Mapping[str, Joint],
        wheels: Mapping[str, Wheel],
        *,
        held: bool,
    ) -> None:
        self._nodes, self.width = nodes, len(nodes.nodes)
        self._frames: dict[str, tuple[Indices, Floats]] = {}
        self.links, self.hinges, self.wheels, self.held = links, hinges, wheels, held

    @cached_property
    def _tree(self) -> JointTree:
        return self._nodes.tree()

    def _frame(self, name: str) -> tuple[Indices, Floats]:
        """Return the axis that a link moves with, shape (1,), and its pose there, shape (1, 12)."""
        found = self._frames.get(name)
        if found is None:
            link = self.links[name]
            found = self._frames[name] = np.array([link.node]), np.array([flat(link.offset)])
        return found

    def place(self, name: str, angles: Floats) -> Place:
        """Return the pose of a link in the model's frame: positions (n, 3), quaternions (n, 4).

        Args:
            name: Scoped name of the link.
            angles: Positions of all axes, shape (n, width).
        """
        link, count = self.links[name], len(angles)
        if link.fixed:
            return (
                np.tile(link.rest.position, (count, 1)),
                np.tile(link.rest.quaternion, (count, 1)),
            )
        poses = self._tree.forward(angles, *self._frame(name))[:, 0]
        return poses[:, :3, 3], from_matrices(poses[:, :3, :3])

    def columns_of(self, name: str) -> Indices:
        """Return columns of the axes that a link hangs on, shape (n,); none if it is fixed."""
        return self._tree.path(self.links[name].node).astype(np.intp)

    def motion(self, name: str, angles: Floats, rates: Floats) -> Place:
        """Return the velocity of a link in the model's frame: linear (n, 3) and angular (n, 3)."""
        link = self.links[name]
        if link.fixed:
            return np.zeros((len(angles), 3)), np.zeros((len(angles), 3))
        jacobian = self._tree.jacobian(angles, link.node, self._frame(name)[1])
        moved = (jacobian @ rates[:, :, None])[..., 0]
        return moved[:, :3], moved[:, 3:]


def link_tree(model: Model, tilt: Pose, *, kinematic: bool = False) -> LinkTree:
    """Return the links and joints of a model.

    Args:
        model: The model.
        tilt: Inclination of its frame in the frame that moves in the plane.
        kinematic: Whether joints are frozen, as those of a static model are.

    Raises:
        EngineError: A joint names a link that is not there.
    """
    nodes = JointNodes(_MOVING, model.pose.inverse(), follow=False)
    links: dict[str, PlanarLink] = {}
    hinges: dict[str, Joint] = {}
    wheels: dict[str, Wheel] = {}
    held = False
    for body in tree_of(model, kinematic=kinematic).bodies:
        nodes.add(body)
        above = model.pose.inverse() if body.parent is None else links[body.parent].rest
        rest = above * body.pose
        held = held or (body.parent is None and body.joint is not None)
        links[body.name] = PlanarLink(body.link, *nodes.frames[body.name], rest)
        if body.joint is None or not nodes.moves(body.joint):
            continue
        hinges[body.joint_name] = body.joint
        wheel = _wheel_of(body, body.joint, tilt * rest)
        if wheel is not None:
            wheels[body.joint_name] = wheel
    return LinkTree(nodes, links, hinges, wheels, held=held)


def _wheel_of(body: TreeLink, joint: Joint, leaning: Pose) -> Wheel | None:
    """Return the wheel that a joint of one axis turns, if it does."""
    if len(joint.axes) != 1 or joint.type == "prismatic":
        return None
    axis = (leaning * joint.pose).rotate(joint.axes[0].xyz)
    return wheel_of(body.joint_name, body.link, leaning, axis)
