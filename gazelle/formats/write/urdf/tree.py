"""A model's links and joints as the tree that URDF requires, and where its frames are.

URDF has a link's frame at its joint, and the root's at the robot's; SDF has it anywhere.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from gazelle.description import Joint, Link, Model, Pose
from gazelle.errors import FormatError
from gazelle.formats.write.writing import Writing
from gazelle.kinematics.joint_graph import JointGraph

WORLD = "world"

_TYPES = {"continuous", "fixed", "floating", "planar", "prismatic", "revolute"}


@dataclass(slots=True)
class WrittenTree:
    """Links and joints arranged as URDF's tree.

    Attributes:
        links: By name, in order.
        joints: Joints of the links to their parents, by the name of the link.
        loops: Joints that close a loop, which URDF has only in SDF's words.
        frames: Pose of each URDF link frame in the model.
        shifts: Pose of each SDF link frame in the URDF one.
    """

    links: Mapping[str, Link]
    joints: dict[str, Joint]
    loops: list[Joint]
    frames: dict[str, Pose] = field(default_factory=dict)
    shifts: dict[str, Pose] = field(default_factory=dict)

    def origin(self, joint: Joint) -> Pose:
        """Return the joint, and the child's frame, in the frame of the parent."""
        if joint.parent == WORLD:
            return self.frames[joint.child]
        return self.frames[joint.parent].inverse() * self.frames[joint.child]


def tree_of(model: Model, writing: Writing) -> WrittenTree:
    """Return the tree of a model.

    Raises:
        FormatError: The links and joints are no tree, or a joint is of a type that URDF lacks.
    """
    if not model.links:
        raise FormatError("URDF needs a link")
    links = {link.name: link for link in model.links}
    tree = WrittenTree(links, *_holding(model, links))
    _join_roots(model, tree, writing)
    _refuse_circles(tree)
    _place(tree)
    moved = [name for name, shift in tree.shifts.items() if shift != Pose()]
    if moved:
        writing.note(
            f"URDF has the frame of a link at its joint: moved the frames of {_listed(moved)}",
            model.source,
        )
    return tree


def _holding(model: Model, links: Mapping[str, Link]) -> tuple[dict[str, Joint], list[Joint]]:
    """Return the joint that holds each link, and those that are left."""
    for joint in model.joints:
        for name in (joint.parent, joint.child):
            if name not in links and name != WORLD:
                raise FormatError(
                    f"the joint '{joint.name}' holds '{name}', which is not a link of this model",
                    source=joint.source,
                )
    graph = JointGraph(joint for joint in model.joints if joint.type in _TYPES)
    rest = [joint for joint in model.joints if graph.holders.get(joint.child) is not joint]
    for joint in rest:
        if joint.child not in graph.holders:
            raise FormatError(
                f"URDF has no '{joint.type}' joint, as '{joint.name}' is", source=joint.source
            )
    return graph.holders, rest


def _join_roots(model: Model, tree: WrittenTree, writing: Writing) -> None:
    """Join all roots of a static model; another one may have only one."""
    roots = [name for name in tree.links if name not in tree.joints]
    on_world = any(joint.parent == WORLD for joint in tree.joints.values())
    if len(roots) + on_world <= 1:
        return
    if not model.static:
        shown = _listed([*roots, *([WORLD] if on_world else [])])
        raise FormatError(
            f"URDF needs one tree of links, but nothing joins {shown}", source=model.source
        )
    parent = WORLD if on_world else roots.pop(0)
    for name in roots:
        link = tree.links[name]
        tree.joints[name] = Joint(f"{parent}_to_{name}", "fixed", parent, name, source=link.source)
    writing.note(
        f"URDF needs one tree of links: fixed joints hold {_listed(roots)} to {parent}",
        model.source,
    )


def _refuse_circles(tree: WrittenTree) -> None:
    graph = JointGraph(tree.joints.values())
    for name in tree.links:
        joint = graph.ring(name)
        if joint is not None:
            raise FormatError(
                f"the joints form a cycle through '{joint.name}'", source=joint.source
            )


def _place(tree: WrittenTree) -> None:
    for name, link in tree.links.items():
        joint = tree.joints.get(name)
        if joint is None:
            tree.frames[name], tree.shifts[name] = Pose(), link.pose
        elif joint.pose == Pose():
            tree.frames[name], tree.shifts[name] = link.pose, Pose()
        else:
            tree.frames[name], tree.shifts[name] = link.pose * joint.pose, joint.pose.inverse()


def _listed(names: Iterable[str]) -> str:
    found = [f"'{name}'" for name in names]
    more = f" and {len(found) - 5} more" if len(found) > 5 else ""
    return ", ".join(found[:5]) + more
