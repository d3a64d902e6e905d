"""Descriptions as URDF text for Bullet, which reads that format best.

URDF puts a link's frame into the joint that carries it, so each link is written in the frame
of its joint; ``Tree.shifts`` tells how far that is from the link's own frame. What Bullet
cannot be told is refused, for a comparison of half a description would mean nothing.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from xml.etree import ElementTree as ET

from gazelle.description import (
    Box,
    Collision,
    Cylinder,
    Inertial,
    Joint,
    Link,
    Model,
    Plane,
    Pose,
    Sphere,
)

WORLD = "world"
_TYPES = {"revolute", "continuous", "prismatic", "fixed"}


class UntranslatableError(Exception):
    """The description says something that this adapter does not tell Bullet."""


@dataclass
class Tree:
    """Links that hang together, as one robot in URDF.

    Attributes:
        root: Scoped name of the root link, or ``WORLD``.
        pose: Of the root in the world.
        text: URDF.
        links: Scoped names of the links but the root, which name their joints too.
        shifts: Where the URDF frame of each link is in the link's own frame.
        joints: The joint that carries each link, by the link's scoped name.
        fixed: Whether the root stays where it is.
    """

    root: str
    pose: Pose
    fixed: bool
    text: str = ""
    links: list[str] = field(default_factory=list)
    shifts: dict[str, Pose] = field(default_factory=dict)
    joints: dict[str, Joint] = field(default_factory=dict)


def trees_of(model: Model) -> tuple[list[Tree], list[Joint]]:
    """Return all trees of a model, and the joints that close loops."""
    if model.models or model.self_collide or any(link.self_collide for link in model.links):
        raise UntranslatableError(f"'{model.name}' has nested models or collides with itself")
    carrying: dict[str, Joint] = {}
    closing = []
    for joint in () if model.static else model.joints:
        if joint.child in carrying:
            closing.append(joint)
        else:
            carrying[joint.child] = joint
    trees = [_tree(model, link.name, carrying) for link in model.links if link.name not in carrying]
    if any(joint.parent == WORLD for joint in carrying.values()):
        trees.append(_tree(model, WORLD, carrying))
    return trees, closing


def _tree(model: Model, root: str, carrying: dict[str, Joint]) -> Tree:
    links = {link.name: link for link in model.links}
    fixed = model.static or root == WORLD
    pose = Pose() if root == WORLD else model.pose * links[root].pose
    tree = Tree(root if root == WORLD else f"{model.name}::{root}", pose, fixed)
    tree.shifts[tree.root] = Pose()
    robot = ET.Element("robot", name=model.name)
    _add_link(robot, tree.root, links.get(root), Pose(), moves=not fixed)
    pending = [root]
    while pending:
        above = pending.pop()
        above_pose = Pose() if above == WORLD else model.pose * links[above].pose
        above_name = WORLD if above == WORLD else f"{model.name}::{above}"
        frame = above_pose * tree.shifts[above_name]
        for joint in (j for j in carrying.values() if j.parent == above):
            name = f"{model.name}::{joint.child}"
            here = model.pose * links[joint.child].pose * joint.pose
            tree.shifts[name] = joint.pose
            tree.joints[name] = joint
            tree.links.append(name)
            _add_link(robot, name, links[joint.child], joint.pose, moves=True)
            _add_joint(robot, joint, (above_name, name), frame.inverse() * here)
            pending.append(joint.child)
    tree.text = ET.tostring(robot, encoding="unicode")
    return tree


def _add_link(robot: ET.Element, name: str, link: Link | None, shift: Pose, *, moves: bool) -> None:
    element = ET.SubElement(robot, "link", name=name)
    if link is None:
        return
    if moves:
        if link.inertial is None or not link.gravity:
            raise UntranslatableError(f"'{name}' has no inertia, or gravity does not pull it")
        _add_inertial(element, link.inertial, shift)
    for collision in link.collisions:
        _add_collision(element, collision, shift)


def _add_inertial(link: ET.Element, inertial: Inertial, shift: Pose) -> None:
    element = ET.SubElement(link, "inertial")
    _add_origin(element, shift.inverse() * inertial.pose)
    ET.SubElement(element, "mass", value=repr(inertial.mass))
    names = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
    values = {name: repr(getattr(inertial.inertia, name)) for name in names}
    ET.SubElement(element, "inertia", values)


def _add_collision(link: ET.Element, collision: Collision, shift: Pose) -> None:
    element = ET.SubElement(link, "collision")
    _add_origin(element, shift.inverse() * collision.pose)
    geometry = ET.SubElement(element, "geometry")
    match collision.geometry:
        case Box(size):
            ET.SubElement(geometry, "box", size=_numbers(size))
        case Sphere(radius):
            ET.SubElement(geometry, "sphere", radius=repr(radius))
        case Cylinder(radius, length):
            ET.SubElement(geometry, "cylinder", radius=repr(radius), length=repr(length))
        case Plane(normal):
            ET.SubElement(geometry, "plane", normal=_numbers(normal))
        case other:
            raise UntranslatableError(f"no {type(other).__name__.lower()} for Bullet")


def _add_joint(robot: ET.Element, joint: Joint, ends: tuple[str, str], origin: Pose) -> None:
    if joint.type not in _TYPES:
        raise UntranslatableError(f"no {joint.type} joint for Bullet")
    axis = joint.axes[0] if joint.axes else None
    limited = axis is not None and math.isfinite(axis.lower) and math.isfinite(axis.upper)
    kind = "continuous" if joint.type == "revolute" and not limited else joint.type
    element = ET.SubElement(robot, "joint", name=ends[1], type=kind)
    _add_origin(element, origin)
    ET.SubElement(element, "parent", link=ends[0])
    ET.SubElement(element, "child", link=ends[1])
    if axis is None or joint.type == "fixed":
        return
    if axis.spring_stiffness:
        raise UntranslatableError(f"joint '{joint.name}' has a spring")
    ET.SubElement(element, "axis", xyz=_numbers(axis.xyz))
    ET.SubElement(element, "dynamics", damping=repr(axis.damping), friction="0")
    if kind != "continuous":
        # Bullet takes a lower limit above the upper one for none.
        lower, upper = (axis.lower, axis.upper) if limited else (0.0, -1.0)
        limits = {"lower": repr(lower), "upper": repr(upper), "effort": "1e9", "velocity": "1e9"}
        ET.SubElement(element, "limit", limits)


def _add_origin(parent: ET.Element, pose: Pose) -> None:
    ET.SubElement(parent, "origin", xyz=_numbers(pose.position), rpy=_numbers(pose.rpy))


def _numbers(values: tuple[float, ...]) -> str:
    return " ".join(repr(float(value)) for value in values)
