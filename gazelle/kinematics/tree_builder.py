"""The tree of joints that a description makes, and the variables of a robot."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

import numpy as np

from gazelle.argument_checks import checked
from gazelle.description import Joint, Model, Pose, VirtualJoint
from gazelle.errors import PlanningError
from gazelle.kinematics.joint_tree import JointTree
from gazelle.kinematics.variables import JointBounds, Variable, bounds_of

WORLD = "world"
"""Parent of joints that hold a robot to the world."""

_SINGLE = ("revolute", "continuous", "prismatic")


@checked(PlanningError)
@dataclass(frozen=True, slots=True)
class LinkFrame:
    """Frame of a link.

    Attributes:
        name: Of the link.
        joint: The joint of the tree that it moves with, -1 for the root.
        offset: Its pose in that joint's frame.
        body: The link of the description that it is part of.
    """

    name: str
    joint: int
    offset: Pose
    body: str


@dataclass(frozen=True, slots=True)
class TreeNode:
    """A joint of the tree: its frame at zero in its parent's, and whom it mimics."""

    name: str
    parent: int
    origin: Pose
    axis: tuple[float, float, float]
    slides: bool
    leader: str = ""
    multiplier: float = 1.0
    offset: float = 0.0


class TreeBuilder:
    """Collects nodes and variables of a robot, depth first from its root.

    Args:
        model: The robot.
        virtual: How it stands in the world; only what is planar has variables.
        limits: By joint, in place of the description's.

    Attributes:
        root: Name of the root link.
        frame: Name of the frame that the tree's root is.
        nodes: Joints, parents first.
        variables: One for each node.

    Raises:
        PlanningError: The robot is no tree with one root.
    """

    def __init__(
        self, model: Model, virtual: Iterable[VirtualJoint], limits: Mapping[str, JointBounds]
    ) -> None:
        self.model, self._limits = model, limits
        self.root = self.frame = _root_of(model)
        self.nodes: list[TreeNode] = []
        self.variables: list[Variable] = []
        self._place: dict[str, tuple[int, Pose]] = {}
        self._add_virtual(virtual)
        self._place[self.root] = (len(self.nodes) - 1, Pose())
        self._walk()

    def _add_virtual(self, joints: Iterable[VirtualJoint]) -> None:
        """Add variables of a base that moves over the ground."""
        for joint in joints:
            if joint.type != "planar" or joint.child_link != self.root:
                continue
            self.frame = joint.parent_frame
            for letter, axis in (("x", (1, 0, 0)), ("y", (0, 1, 0)), ("theta", (0, 0, 1))):
                turns = letter == "theta"
                bounds = self._limits.get(f"{joint.name}/{letter}", JointBounds())
                kind = "continuous" if turns else "prismatic"
                variable = Variable(f"{joint.name}/{letter}", joint.name, kind, bounds)
                self.variables.append(variable)
                axis_of = (float(axis[0]), float(axis[1]), float(axis[2]))
                parent = len(self.nodes) - 1
                self.nodes.append(
                    TreeNode(variable.name, parent, Pose(), axis_of, slides=not turns)
                )

    def _walk(self) -> None:
        """Add nodes and variables of all joints, depth first; links' places."""
        poses = {link.name: link.pose for link in self.model.links} | {WORLD: Pose()}
        below: dict[str, list[Joint]] = {}
        for joint in self.model.joints:
            below.setdefault(joint.parent, []).append(joint)
        waiting = list(reversed(below.get(self.root, [])))
        while waiting:
            joint = waiting.pop()
            node, offset = self._place[joint.parent]
            to_child = offset * poses[joint.parent].inverse() * poses[joint.child]
            if joint.type in _SINGLE and joint.axes:
                node = self._add_joint(joint, node, to_child)
                to_child = joint.pose.inverse()
            self._place[joint.child] = (node, to_child)
            waiting.extend(reversed(below.get(joint.child, [])))

    def _add_joint(self, joint: Joint, parent: int, child: Pose) -> int:
        axis = joint.axes[0]
        mimics = axis.mimic is not None
        bounds = self._limits.get(joint.name) or bounds_of(joint)
        variable = Variable(joint.name, joint.name, joint.type, bounds, mimics=mimics)
        self.variables.append(variable)
        slides = joint.type == "prismatic"
        node = TreeNode(joint.name, parent, child * joint.pose, axis.xyz, slides=slides)
        if axis.mimic is not None:
            mimic = axis.mimic
            offset = mimic.offset - mimic.multiplier * mimic.reference
            node = replace(node, leader=mimic.joint, multiplier=mimic.multiplier, offset=offset)
        self.nodes.append(node)
        return len(self.nodes) - 1

    def source(self, node: TreeNode) -> tuple[int, float, float]:
        """Return the variable that a joint finally follows, its factor and its offset."""
        nodes = {each.name: each for each in self.nodes}
        factor, offset, seen = node.multiplier, node.offset, {node.name}
        while node.leader and node.leader in nodes and node.leader not in seen:
            node = nodes[node.leader]
            seen.add(node.name)
            offset += factor * node.offset
            factor *= node.multiplier
        return list(nodes).index(node.name), factor, offset

    def tree(self) -> JointTree:
        """Return the compiled tree."""
        nodes = self.nodes
        sources = [self.source(node) for node in nodes]
        return JointTree(
            np.array([node.parent for node in nodes], np.int32),
            np.array([flat(node.origin) for node in nodes]).reshape(-1, 12),
            np.array([node.axis for node in nodes], np.float64).reshape(-1, 3),
            np.array([node.slides for node in nodes], bool),
            np.array([source[0] for source in sources], np.int32),
            np.array([source[1] for source in sources], np.float64),
            np.array([source[2] for source in sources], np.float64),
        )

    def links(self) -> dict[str, LinkFrame]:
        """Return all links by name, depth first, and then those that are parts of others."""
        links = {
            name: LinkFrame(name, node, offset, name)
            for name, (node, offset) in self._place.items()
        }
        for frame in self.model.frames:
            base = links.get(frame.attached_to)
            if base is not None:
                links.setdefault(
                    frame.name,
                    LinkFrame(frame.name, base.joint, base.offset * frame.pose, base.body),
                )
        return links


def flat(pose: Pose) -> list[float]:
    """Return a pose as the twelve numbers of ``joint_tree``."""
    matrix = pose.matrix()
    return [*matrix[:3, :3].ravel().tolist(), *pose.position]


def _root_of(model: Model) -> str:
    """Return the root link; the world where joints hold all to it."""
    held = {joint.child for joint in model.joints}
    roots = [link.name for link in model.links if link.name not in held]
    if any(joint.parent == WORLD for joint in model.joints):
        roots.append(WORLD)
    if len(roots) != 1:
        raise PlanningError(
            f"planning needs a robot with one root link; '{model.name}' has {len(roots)}",
            source=model.source,
        )
    return roots[0]
