"""Links and joints of a URDF as a tree, and which links are lumped into which.

A fixed joint holds two links together for good, so libsdformat makes them one body unless
``<preserveFixedJoint>`` or ``<disableFixedJointLumping>`` is set.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from gazelle.description import Inertial, Parameters, Pose
from gazelle.errors import FormatError, did_you_mean, few
from gazelle.formats import values
from gazelle.formats.reading import Reading
from gazelle.formats.urdf.elements import read_inertial
from gazelle.formats.urdf.extensions import Extensions
from gazelle.formats.urdf.joint import UrdfJoint, read_joint
from gazelle.formats.urdf.upright import upright
from gazelle.kinematics.joint_graph import JointGraph

WORLD = "world"
_ONLY_MACROS = "a xacro file that only defines macros is meant to be included by another"


class NoLinksError(FormatError):
    """A robot without a link, as a xacro file has that only defines macros."""


def require_links(root: Parameters) -> None:
    """Check that a ``<robot>`` has links.

    Raises:
        NoLinksError: It has none.
    """
    if root.find("link") is None:
        raise NoLinksError("a <robot> needs a <link>", source=root.source, hint=_ONLY_MACROS)


@dataclass(frozen=True, slots=True)
class UrdfLink:
    """A link as written."""

    name: str
    inertial: Inertial | None
    node: Parameters


@dataclass(frozen=True, slots=True)
class Member:
    """A link that is part of a body, its pose there, and the fixed joint that lumps it.

    Masses are lumped at ``upright``, by angles that urdfdom gives: see there.
    """

    link: UrdfLink
    pose: Pose
    joint: UrdfJoint | None = None
    upright: Pose = field(default_factory=Pose)


@dataclass(slots=True)
class LumpedLink:
    """Links that move as one.

    Attributes:
        link: The one that gives name and frame.
        pose: Of that link in the model.
        joint: Joint to its parent body; None for the root.
        parent: Name of the parent body.
        origin: Of the joint in the parent body.
        members: The link itself, then those lumped into it.
        children: Bodies that hang on it.
    """

    link: UrdfLink
    pose: Pose
    joint: UrdfJoint | None = None
    parent: str = ""
    origin: Pose = field(default_factory=Pose)
    members: list[Member] = field(default_factory=list)
    children: list[LumpedLink] = field(default_factory=list)

    @property
    def name(self) -> str:
        """Name of the body."""
        return self.link.name


@dataclass(slots=True)
class UrdfTree:
    """Links, joints and the joints below each link, sorted by name as urdfdom does."""

    links: dict[str, UrdfLink]
    joints: dict[str, UrdfJoint]
    below: dict[str, list[UrdfJoint]]
    root: str


def read_tree(root: Parameters, reading: Reading) -> UrdfTree:
    """Read the links and joints of a ``<robot>``.

    Raises:
        FormatError: They are not one tree.
        NoLinksError: There is none.
    """
    require_links(root)
    links: dict[str, UrdfLink] = {}
    for node in root.find_all("link"):
        name = values.attribute(node, "name")
        _refuse_twice(node, name, links)
        links[name] = UrdfLink(name, read_inertial(node.find("inertial"), reading), node)
    joints: dict[str, UrdfJoint] = {}
    for node in root.find_all("joint"):
        joint = read_joint(node, reading)
        _refuse_twice(node, joint.name, joints)
        _refuse_missing(joint, links)
        joints[joint.name] = joint
    graph = JointGraph(joints[name] for name in sorted(joints))
    _refuse_second_holders(graph)
    top = _root(root, links, graph)
    _refuse_loops(top, links, graph)
    return UrdfTree(links, joints, graph.below, top)


def _refuse_twice(node: Parameters, name: str, known: object) -> None:
    if isinstance(known, dict) and name in known:
        raise values.fail(node, f"there is already a <{node.tag}> named '{name}'")


def _refuse_missing(joint: UrdfJoint, links: dict[str, UrdfLink]) -> None:
    for tag, name in (("parent", joint.parent), ("child", joint.child)):
        if name not in links and not (tag == "parent" and name == WORLD):
            raise values.fail(
                joint.node.find(tag) or joint.node,
                f"the joint's {tag} '{name}' is not a link of this robot",
                hint=did_you_mean(name, links),
            )


def _refuse_second_holders(graph: JointGraph[UrdfJoint]) -> None:
    for joint in graph.rest:
        raise values.fail(
            joint.node,
            f"link '{joint.child}' is the child of two joints, "
            f"'{graph.holders[joint.child].name}' and '{joint.name}': this is a joint loop, "
            "which URDF cannot hold",
            hint="close the loop with an SDF <joint> inside a <gazebo>",
        )


def _root(root: Parameters, links: dict[str, UrdfLink], graph: JointGraph[UrdfJoint]) -> str:
    tops = graph.roots(links)
    if WORLD in graph.below and WORLD not in links:
        tops.append(WORLD)
    if not tops:
        raise values.fail(root, "every link is the child of a joint: this is a joint loop")
    if len(tops) > 1:
        raise values.fail(
            links[tops[1]].node if tops[1] in links else root,
            f"the robot has {len(tops)} roots: {few(tops)}",
            hint="connect all of them but one by joints",
        )
    return tops[0]


def _refuse_loops(top: str, links: dict[str, UrdfLink], graph: JointGraph[UrdfJoint]) -> None:
    reached = {top, *(joint.child for joint in graph.outwards(top))}
    for joint in graph.holders.values():
        if joint.child not in reached:
            circle = [name for name in links if name not in reached]
            raise values.fail(joint.node, f"these links form a joint loop: {few(circle)}")


def lumps(joint: UrdfJoint, extensions: Extensions) -> bool:
    """Return whether the joint's child becomes part of the parent's body."""
    if joint.type != "fixed" or joint.parent == WORLD:
        return False
    return not (
        extensions.yes(joint.name, "preserveFixedJoint")
        or extensions.yes(joint.name, "disableFixedJointLumping")
    )


def bodies(tree: UrdfTree, extensions: Extensions) -> list[LumpedLink]:
    """Return all bodies, parents before children, without the world."""
    done: list[LumpedLink] = []
    if tree.root == WORLD:
        first = [
            _child_of(tree, joint, LumpedLink(UrdfLink(WORLD, None, joint.node), Pose()), Pose())
            for joint in tree.below.get(WORLD, ())
        ]
    else:
        first = [LumpedLink(tree.links[tree.root], Pose())]
    waiting = first[::-1]
    while waiting:
        body = waiting.pop()
        _gather(tree, body, extensions)
        done.append(body)
        waiting.extend(reversed(body.children))
    return done


def _child_of(tree: UrdfTree, joint: UrdfJoint, parent: LumpedLink, link_pose: Pose) -> LumpedLink:
    """Return the child link of a joint, posed in the model."""
    origin = link_pose * joint.origin
    return LumpedLink(tree.links[joint.child], parent.pose * origin, joint, parent.name, origin)


def _gather(tree: UrdfTree, body: LumpedLink, extensions: Extensions) -> None:
    """Find all links of a body, each before those on it, and the bodies that hang on it."""
    waiting = [Member(body.link, Pose())]
    while waiting:
        member = waiting.pop()
        body.members.append(member)
        lumped = []
        for joint in tree.below.get(member.link.name, ()):
            if lumps(joint, extensions):
                pose = member.pose * joint.origin
                stood = member.upright * upright(joint.origin)
                lumped.append(Member(tree.links[joint.child], pose, joint, stood))
            else:
                body.children.append(_child_of(tree, joint, body, member.pose))
        waiting.extend(reversed(lumped))
