"""Links and joints of a model as a tree of bodies, which is how MuJoCo wants them."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Literal

from gazelle.description import Joint, Link, Model, Pose
from gazelle.errors import EngineError, did_you_mean

RootKind = Literal["free", "static", "kinematic"]


@dataclass(frozen=True, slots=True)
class Body:
    """A link's place in the tree.

    Attributes:
        name: Scoped name, ``model::link``.
        link: What it is.
        parent: Scoped name of the parent body; None for the world.
        pose: In the parent body's frame, or in the world, with all joints at zero.
        joint: The joint to its parent, if any.
        joint_name: That joint's scoped name.
        root: How a body without a joint moves; None for one with a joint.
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
class _Part:
    """A link with its pose in the world."""

    link: Link
    pose: Pose
    self_collide: bool


def bodies_of(model: Model, *, kinematic: bool = False) -> list[Body]:
    """All bodies of a model and its nested models, parents before children.

    Raises:
        EngineError: A joint names a link that is not there, two joints move one link, or
            the joints form a loop.
    """
    parts = _parts_of(model)
    root: RootKind = "kinematic" if kinematic else "static" if model.static else "free"
    if root != "free":
        return [
            Body(name, part.link, None, part.pose, None, "", root, part.self_collide)
            for name, part in parts.items()
        ]
    joints = _joints_by_child(model, parts)
    children = defaultdict(list)
    for name in parts:
        parent = _parent_of(joints[name][1]) if name in joints else None
        children[parent].append(name)
    bodies = list(_walk(None, children, parts, joints))
    if len(bodies) < len(parts):
        stuck = min(set(parts) - {body.name for body in bodies})
        scoped, joint = joints[stuck]
        raise EngineError(
            f"the joints form a loop through joint '{scoped}' and link '{stuck}'; "
            "none of its links is held by the world or free",
            source=joint.source,
        )
    return bodies


def _walk(
    parent: str | None,
    children: dict[str | None, list[str]],
    parts: dict[str, _Part],
    joints: dict[str, tuple[str, Joint]],
) -> Iterator[Body]:
    pending = [(name, parent) for name in reversed(children[parent])]
    while pending:
        name, above = pending.pop()
        part = parts[name]
        pose = part.pose if above is None else parts[above].pose.inverse() * part.pose
        scoped, joint = joints.get(name, ("", None))
        root: RootKind | None = "free" if joint is None else None
        yield Body(name, part.link, above, pose, joint, scoped, root, part.self_collide)
        pending.extend((child, name) for child in reversed(children[name]))


def _parts_of(model: Model) -> dict[str, _Part]:
    parts: dict[str, _Part] = {}
    for placed in model.walk():
        for link in placed.model.links:
            collide = placed.model.self_collide if link.self_collide is None else link.self_collide
            parts[f"{placed.scope}::{link.name}"] = _Part(link, placed.pose * link.pose, collide)
    return parts


def _joints_by_child(model: Model, parts: dict[str, _Part]) -> dict[str, tuple[str, Joint]]:
    found: dict[str, tuple[str, Joint]] = {}
    for placed in model.walk():
        for joint in placed.model.joints:
            scoped = f"{placed.scope}::{joint.name}"
            child = f"{placed.scope}::{joint.child}"
            _require(child, joint, "child", parts)
            parent = None if joint.parent == "world" else f"{placed.scope}::{joint.parent}"
            if parent is not None:
                _require(parent, joint, "parent", parts)
            if child in found:
                raise EngineError(
                    f"link '{child}' is the child of two joints, '{found[child][0]}' and "
                    f"'{scoped}'; loops of joints are not simulated yet",
                    source=joint.source,
                    hint="leave one of the two joints out",
                )
            found[child] = (scoped, _scoped(joint, parent))
    return found


def _scoped(joint: Joint, parent: str | None) -> Joint:
    return replace(joint, parent=parent or "world")


def _parent_of(joint: Joint) -> str | None:
    return None if joint.parent == "world" else joint.parent


def _require(link: str, joint: Joint, role: str, parts: dict[str, _Part]) -> None:
    if link not in parts:
        raise EngineError(
            f"joint '{joint.name}' has the {role} link '{link}', which is not there",
            source=joint.source,
            hint=did_you_mean(link, parts),
        )
