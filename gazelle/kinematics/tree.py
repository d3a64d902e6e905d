"""Links and joints of a model as a tree of bodies."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Literal

from gazelle.description import Joint, JointAxis, Link, Model, PlacedModel, Pose
from gazelle.errors import EngineError, did_you_mean

# Joints that two bodies held at points do not make.
_ONLY_IN_TREES = ("floating", "planar", "prismatic", "revolute2", "universal")

# Limits so far off are none [m or rad].
_FAR = 1e4

FARTHEST = 1e10
"""Largest coordinate of a pose, and largest speed, that physics can hold [m, m/s or rad/s]."""

RootKind = Literal["free", "static", "kinematic"]


@dataclass(frozen=True, slots=True)
class TreeLink:
    """A link's place in the tree.

    Attributes:
        name: Scoped name, ``model::link``.
        link: The link.
        parent: Scoped name of the parent body; None for the world.
        pose: In the parent body's frame, or in the world, with all joints at zero.
        joint: The joint to its parent, if any.
        joint_name: Scoped name of that joint.
        root: Motion of a body without a joint; None for one with a joint.
        self_collide: Whether it collides with bodies of its own model.
    """

    name: str
    link: Link
    parent: str | None
    pose: Pose
    joint: Joint | None
    joint_name: str
    root: RootKind | None
    self_collide: bool


@dataclass(frozen=True, slots=True)
class _PosedLink:
    """A link with its pose in the world, and whether its own model never moves."""

    link: Link
    pose: Pose
    self_collide: bool
    static: bool


@dataclass(frozen=True, slots=True)
class Closure:
    """A joint that no tree can hold: it closes a loop, or couples two joints.

    Attributes:
        name: Scoped name.
        joint: The joint; parent and child are scoped, or ``world``.
        pose: The joint frame in the child body's frame.
    """

    name: str
    joint: Joint
    pose: Pose


@dataclass(frozen=True, slots=True)
class KinematicTree:
    """A model as a kinematic tree: links with parents first, and remaining loop closures."""

    bodies: list[TreeLink]
    closures: list[Closure]


def tree_of(model: Model, *, kinematic: bool = False) -> KinematicTree:
    """Return all bodies of a model and its nested models, and the joints that close loops.

    Of several joints that move one link the tree's is the first that would lose something if
    it closed a loop, or else the first in the file. Where joints form a ring with no end, the
    first link in the file is let free and its joint closes it.

    Raises:
        EngineError: A joint names a link that is not there, or a link is too far away.
    """
    parts = _parts_of(model)
    root: RootKind = "kinematic" if kinematic else "static" if model.static else "free"
    if root != "free":
        bodies = [
            TreeLink(name, part.link, None, part.pose, None, "", root, part.self_collide)
            for name, part in parts.items()
        ]
        return KinematicTree(bodies, [])
    joints, closures = _sort_joints(model, parts)
    held, opened = _open_rings(parts, joints)
    children = defaultdict(list)
    for name in parts:
        parent = _parent_of(held[name][1]) if name in held else None
        children[parent].append(name)
    return KinematicTree(list(_walk(children, parts, held)), closures + opened)


def _walk(
    children: dict[str | None, list[str]],
    parts: dict[str, _PosedLink],
    joints: dict[str, tuple[str, Joint]],
) -> Iterator[TreeLink]:
    pending: list[tuple[str, str | None]] = [(name, None) for name in reversed(children[None])]
    while pending:
        name, above = pending.pop()
        part = parts[name]
        pose = part.pose if above is None else parts[above].pose.inverse() * part.pose
        scoped, joint = joints.get(name, ("", None))
        root: RootKind | None = "free" if joint is None else None
        if part.static:
            root = "static"
        yield TreeLink(name, part.link, above, pose, joint, scoped, root, part.self_collide)
        pending.extend((child, name) for child in reversed(children[name]))


def _parts_of(model: Model) -> dict[str, _PosedLink]:
    parts: dict[str, _PosedLink] = {}
    fixed = [f"{placed.scope}::" for placed in model.walk() if placed.model.static]
    for placed in model.walk():
        static = any(f"{placed.scope}::".startswith(scope) for scope in fixed)
        for link in placed.model.links:
            collide = placed.model.self_collide if link.self_collide is None else link.self_collide
            if placed.model.enable_wind and not link.enable_wind:
                link = replace(link, enable_wind=True)  # noqa: PLW2901
            name, pose = f"{placed.scope}::{link.name}", placed.pose * link.pose
            if not all(abs(each) <= FARTHEST for each in pose.position):
                raise EngineError(
                    f"link '{name}' cannot be at {pose}: that is too far away",
                    source=link.source or placed.model.source,
                )
            parts[name] = _PosedLink(link, pose, collide, static)
    return parts


def _sort_joints(
    model: Model, parts: dict[str, _PosedLink]
) -> tuple[dict[str, tuple[str, Joint]], list[Closure]]:
    """Return the joint that carries each link, and those left over."""
    carrying: dict[str, tuple[str, Joint]] = {}
    closures: list[Closure] = []
    for placed in model.walk():
        for joint in placed.model.joints:
            scoped = f"{placed.scope}::{joint.name}"
            child = f"{placed.scope}::{joint.child}"
            parent = "world" if joint.parent == "world" else f"{placed.scope}::{joint.parent}"
            _require(child, joint, "child", parts)
            if parent != "world":
                _require(parent, joint, "parent", parts)
            if parts[child].static:
                continue
            if parent != "world" and parts[parent].static:
                parent = "world"
            full = replace(joint, parent=parent, child=child, axes=_scoped_mimic(joint, placed))
            if joint.type == "gearbox" or child in carrying:
                closures.append(Closure(scoped, full, joint.pose))
            else:
                carrying[child] = (scoped, full)
    return carrying, [_exchanged(closure, carrying) for closure in closures]


def _exchanged(closure: Closure, carrying: dict[str, tuple[str, Joint]]) -> Closure:
    """Return the closure, or the link's joint if that would lose less by closing."""
    joint = closure.joint
    if joint.type == "gearbox" or not lost_in_loop(joint):
        return closure
    name, held = carrying[joint.child]
    above = _parent_of(joint)
    while above is not None and above != joint.child:
        above = _parent_of(carrying[above][1]) if above in carrying else None
    if lost_in_loop(held) or above is not None:
        return closure
    carrying[joint.child] = (closure.name, joint)
    return Closure(name, held, held.pose)


def lost_in_loop(joint: Joint) -> tuple[str, ...]:
    """Describe the properties of a joint that only the tree keeps; empty for none."""
    if joint.type in _ONLY_IN_TREES:
        return (f"type '{joint.type}'",)
    if joint.type == "screw":  # a link of its own does all that it does
        return ()
    lost = [
        word
        for axis in joint.axes
        for word, there in (
            ("damping", axis.damping != 0.0),
            ("friction", axis.friction != 0.0),
            ("spring", axis.spring_stiffness != 0.0),
            ("armature", axis.armature != 0.0),
            ("mimic", axis.mimic is not None),
            ("limits", joint.type != "continuous" and _is_limited(axis)),
        )
        if there
    ]
    return tuple(dict.fromkeys(lost))


def _is_limited(axis: JointAxis) -> bool:
    return axis.lower > -_FAR or axis.upper < _FAR


def _open_rings(
    parts: dict[str, _PosedLink], joints: dict[str, tuple[str, Joint]]
) -> tuple[dict[str, tuple[str, Joint]], list[Closure]]:
    """Cut every ring of joints at its first link whose joint loses nothing by it."""
    held, opened = dict(joints), []
    places = {name: place for place, name in enumerate(parts)}
    clear: set[str] = set()  # links that lead to a root
    for name in parts:
        path: dict[str, int] = {}
        link: str | None = name
        while link is not None and link in held and link not in path and link not in clear:
            path[link] = len(path)
            link = _parent_of(held[link][1])
        if link is not None and link in path:
            inside = sorted(list(path)[path[link] :], key=places.__getitem__)
            first = min(inside, key=lambda each: bool(lost_in_loop(held[each][1])))
            scoped, joint = held.pop(first)
            opened.append(Closure(scoped, joint, joint.pose))
        clear.update(path)
    return held, opened


def _scoped_mimic(joint: Joint, placed: PlacedModel) -> tuple[JointAxis, ...]:
    """Return the axes with the names of leading joints scoped."""
    return tuple(
        axis
        if axis.mimic is None
        else replace(axis, mimic=replace(axis.mimic, joint=f"{placed.scope}::{axis.mimic.joint}"))
        for axis in joint.axes
    )


def _parent_of(joint: Joint) -> str | None:
    return None if joint.parent == "world" else joint.parent


def _require(link: str, joint: Joint, role: str, parts: dict[str, _PosedLink]) -> None:
    if link not in parts:
        raise EngineError(
            f"joint '{joint.name}' has the {role} link '{link}', which is not there",
            source=joint.source,
            hint=did_you_mean(link, parts),
        )
