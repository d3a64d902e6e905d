"""Axes of the joints of a tree as the nodes that `JointTree` moves."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

import numpy as np

from gazelle.description import Joint, JointAxis, Mimic, Pose
from gazelle.kinematics.joint_tree import JointTree
from gazelle.kinematics.tree import TreeLink


@dataclass(frozen=True, slots=True)
class JointNode:
    """One axis of a joint.

    Attributes:
        name: Name of the joint.
        parent: Index of the node that it moves with, -1 for the root.
        origin: Pose of its frame at zero in the parent's frame.
        axis: Unit vector in its frame.
        slides: True if it slides along the axis rather than turning about it.
        mimic: The joint that it follows, if any.
    """

    name: str
    parent: int
    origin: Pose
    axis: tuple[float, float, float]
    slides: bool
    mimic: Mimic | None = None


class JointNodes:
    """Nodes of a tree, parents before children.

    Args:
        moving: Types of the joints that move; links on other joints are fixed to their parents.
        base: Pose of the world in the frame of the tree's root.
        follow: Whether joints that mimic others follow them.

    Attributes:
        nodes: One node for each axis.
        frames: Node that each link moves with, -1 for the root, and the link's pose in its frame.
    """

    def __init__(self, moving: Collection[str], base: Pose, *, follow: bool) -> None:
        self._moving, self._follow = moving, follow
        self.nodes: list[JointNode] = []
        self.frames: dict[str | None, tuple[int, Pose]] = {None: (-1, base)}

    def moves(self, joint: Joint | None) -> bool:
        """Return whether a joint has nodes."""
        return joint is not None and joint.type in self._moving and bool(joint.axes)

    def add(self, body: TreeLink) -> None:
        """Add a link below an existing parent, and the axes of its joint."""
        node, offset = self.frames[body.parent]
        pose = offset * body.pose
        if body.joint is not None and self.moves(body.joint):
            origin = pose * body.joint.pose
            for axis in body.joint.axes:
                node = self.append(self._node_of(body, axis, node, origin))
                origin = Pose()
            pose = body.joint.pose.inverse()
        self.frames[body.name] = node, pose

    def append(self, node: JointNode) -> int:
        """Add a node and return its index."""
        self.nodes.append(node)
        return len(self.nodes) - 1

    def _node_of(self, body: TreeLink, axis: JointAxis, parent: int, origin: Pose) -> JointNode:
        slides = body.joint is not None and body.joint.type == "prismatic"
        mimic = axis.mimic if self._follow else None
        return JointNode(body.joint_name, parent, origin, axis.xyz, slides, mimic)

    def sources(self) -> list[tuple[int, float, float]]:
        """Return the node with the variable that moves each node, with a factor and an offset."""
        places = {node.name: index for index, node in enumerate(self.nodes)}
        return [self._source(index, places) for index in range(len(self.nodes))]

    def _source(self, index: int, places: dict[str, int]) -> tuple[int, float, float]:
        factor, offset, seen = 1.0, 0.0, {index}
        mimic = self.nodes[index].mimic
        while mimic is not None and places.get(mimic.joint, index) not in seen:
            offset += factor * (mimic.offset - mimic.multiplier * mimic.reference)
            factor *= mimic.multiplier
            index = places[mimic.joint]
            seen.add(index)
            mimic = self.nodes[index].mimic
        return index, factor, offset

    def tree(self) -> JointTree:
        """Return the nodes compiled."""
        nodes, sources = self.nodes, self.sources()
        return JointTree(
            np.array([node.parent for node in nodes], np.int32),
            np.array([flat(node.origin) for node in nodes]).reshape(-1, 12),
            np.array([node.axis for node in nodes], np.float64).reshape(-1, 3),
            np.array([node.slides for node in nodes], bool),
            np.array([source[0] for source in sources], np.int32),
            np.array([source[1] for source in sources], np.float64),
            np.array([source[2] for source in sources], np.float64),
        )


def flat(pose: Pose) -> list[float]:
    """Return a pose as the twelve numbers of `JointTree`."""
    matrix = pose.matrix()
    return [*matrix[:3, :3].ravel().tolist(), *pose.position]
