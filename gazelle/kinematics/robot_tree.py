"""Variables, axes and links of a robot, depth first from its root."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace

from gazelle.argument_checks import checked
from gazelle.description import Joint, JointAxis, Model, Pose, VirtualJoint
from gazelle.errors import PlanningError
from gazelle.kinematics.joint_graph import JointGraph
from gazelle.kinematics.joint_nodes import JointNode, JointNodes
from gazelle.kinematics.mimics import leaders_of, mimic_cycles, refuse_cycle
from gazelle.kinematics.tree import TreeLink, tree_of
from gazelle.kinematics.variables import JointBounds, Variable, bounds_of

WORLD = "world"
"""Parent of joints that hold a robot to the world."""

_SINGLE = frozenset({"revolute", "continuous", "prismatic"})


@checked(PlanningError)
@dataclass(frozen=True, slots=True)
class LinkFrame:
    """Frame of a link.

    Attributes:
        name: Of the link.
        joint: Index of the node that it moves with, -1 for the root.
        offset: Its pose in that node's frame.
        body: The link of the description that it is part of.
    """

    name: str
    joint: int
    offset: Pose
    body: str


class RobotTree:
    """Tree of a robot; names are relative to the robot, such as ``gripper::palm``.

    Args:
        model: The robot.
        virtual: Joints that hold it to the world; only planar ones have variables.
        limits: Limits by joint, in place of the description's.

    Attributes:
        root: Name of the root link.
        frame: Name of the frame that the tree's root is.
        bodies: Links of the description by name, depth first, in the order of the joints.
        graph: Joints of the tree, those that do not move too.
        closing: Joints that close loops; they have no variables.
        nodes: Axes of the joints, one for each variable.
        variables: In the order of the nodes.

    Raises:
        PlanningError: The robot has no root link, or several.
        EngineError: A joint names a link that is not there.
    """

    def __init__(
        self, model: Model, virtual: Iterable[VirtualJoint], limits: Mapping[str, JointBounds]
    ) -> None:
        self._model, self._limits = replace(model, static=False, pose=Pose()), limits
        found = tree_of(self._model)
        bodies = [self._renamed(body) for body in found.bodies]
        self.closing = tuple(self._joint(each.joint, each.name) for each in found.closures)
        self.root = self.frame = _root_of(model, bodies)
        self.variables: list[Variable] = []
        self.nodes = JointNodes(_SINGLE, Pose(), follow=True)
        self._add_virtual(virtual)
        self.nodes.frames[self.root] = (len(self.nodes.nodes) - 1, Pose())
        self.graph = JointGraph(self._in_order([b.joint for b in bodies if b.joint is not None]))
        joints = ((each.joint_name, each.joint) for each in bodies if each.joint)
        cycles = mimic_cycles(leaders_of(joints))
        by_name = {body.name: body for body in bodies}
        self.bodies = {} if self.root == WORLD else {self.root: by_name[self.root]}
        for joint in self.graph.outwards(self.root):
            refuse_cycle(joint.name, joint, cycles, PlanningError)
            self.bodies[joint.child] = by_name[joint.child]
            self._add(by_name[joint.child], joint)

    def _relative(self, name: str) -> str:
        return name.removeprefix(f"{self._model.name}::")

    def _renamed(self, body: TreeLink) -> TreeLink:
        name = self._relative(body.joint_name)
        joint = None if body.joint is None else self._joint(body.joint, body.joint_name)
        parent = None if body.parent is None else self._relative(body.parent)
        return replace(
            body, name=self._relative(body.name), parent=parent, joint=joint, joint_name=name
        )

    def _joint(self, joint: Joint, name: str) -> Joint:
        return replace(
            joint,
            name=self._relative(name),
            parent=self._relative(joint.parent),
            child=self._relative(joint.child),
            axes=tuple(self._axis(axis) for axis in joint.axes),
        )

    def _axis(self, axis: JointAxis) -> JointAxis:
        if axis.mimic is None:
            return axis
        return replace(axis, mimic=replace(axis.mimic, joint=self._relative(axis.mimic.joint)))

    def _in_order(self, joints: list[Joint]) -> list[Joint]:
        """Return joints in the order of the description, which that of variables follows."""
        every = (f"{p.scope}::{j.name}" for p in self._model.walk() for j in p.model.joints)
        order = {self._relative(name): place for place, name in enumerate(every)}
        return sorted(joints, key=lambda joint: order[joint.name])

    def _add_virtual(self, joints: Iterable[VirtualJoint]) -> None:
        """Add variables of a base that moves over the ground."""
        for joint in joints:
            if joint.type != "planar" or joint.child_link != self.root:
                continue
            self.frame = joint.parent_frame
            for letter, axis in (("x", (1.0, 0.0, 0.0)), ("y", (0.0, 1.0, 0.0)), ("theta", _UP)):
                turns, name = letter == "theta", f"{joint.name}/{letter}"
                bounds = self._limits.get(name, JointBounds())
                kind = "continuous" if turns else "prismatic"
                self.variables.append(Variable(name, joint.name, kind, bounds))
                parent = len(self.nodes.nodes) - 1
                self.nodes.append(JointNode(name, parent, Pose(), axis, slides=not turns))

    def _add(self, body: TreeLink, joint: Joint) -> None:
        """Add a link that hangs on a joint, with the joint's variable."""
        if self.nodes.moves(joint):
            bounds = self._limits.get(joint.name) or bounds_of(joint)
            mimics = joint.axes[0].mimic is not None
            self.variables.append(
                Variable(joint.name, joint.name, joint.type, bounds, mimics=mimics)
            )
        self.nodes.add(body)

    def links(self) -> dict[str, LinkFrame]:
        """Return all links by name, depth first, and then those that are parts of others."""
        links = {
            name: LinkFrame(name, node, offset, name)
            for name in dict.fromkeys((self.root, *self.bodies))
            for node, offset in (self.nodes.frames[name],)
        }
        for name, attached_to, pose in self._frames():
            base = links.get(attached_to)
            if base is not None:
                links.setdefault(name, LinkFrame(name, base.joint, base.offset * pose, base.body))
        return links

    def parts(self) -> dict[str, str]:
        """Return the link that each frame of the description is attached to, by name."""
        return {name: attached_to for name, attached_to, _ in self._frames()}

    def _frames(self) -> Iterator[tuple[str, str, Pose]]:
        for placed in self._model.walk():
            for frame in placed.model.frames:
                name, link = f"{placed.scope}::{frame.name}", f"{placed.scope}::{frame.attached_to}"
                yield self._relative(name), self._relative(link), frame.pose


_UP = (0.0, 0.0, 1.0)


def _root_of(model: Model, bodies: Iterable[TreeLink]) -> str:
    """Return the one link that no joint holds; the world where joints hold all to it."""
    tops = [body for body in bodies if body.parent is None]
    roots = [body.name for body in tops if body.joint is None]
    if len(roots) < len(tops):
        roots.append(WORLD)
    if len(roots) != 1:
        raise PlanningError(
            f"planning needs a robot with one root link; '{model.name}' has {len(roots)}",
            source=model.source,
        )
    return roots[0]
