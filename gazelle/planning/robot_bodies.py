"""A robot as bodies that collide: a body for each joint, and one for each link with shapes."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from gazelle.description import Collision, Pose
from gazelle.engines.collision import CollisionBody
from gazelle.kinematics.robot_model import RobotModel
from gazelle.planning.scene_objects import AttachedObject, scaled

_LINK = re.compile(r"link\[@name='([^']+)'\]")


def robot_bodies(
    robot: RobotModel, scale: Mapping[str, float], attached: Sequence[AttachedObject]
) -> list[CollisionBody]:
    """Return bodies of a robot and its attached objects, in the order of the robot's variables.

    Links that a description has made part of others are bodies of their own again.

    Args:
        robot: The robot.
        scale: Factors of shapes, by link.
        attached: Objects held by links.
    """
    names = [f" {node.name}" for node in robot.nodes]
    bodies = [
        CollisionBody(
            f" {node.name}",
            names[node.parent] if node.parent >= 0 else "",
            node.origin,
            axis=node.axis,
            slides=node.slides,
        )
        for node in robot.nodes
    ]
    shapes = shapes_of(robot)
    for name, link in robot.links.items():
        parts = tuple(
            (scaled(each.geometry, scale.get(name, 1.0)), pose) for each, pose in shapes[name]
        )
        parent = names[link.joint] if link.joint >= 0 else ""
        bodies.append(CollisionBody(name, parent, link.offset, parts))
    bodies.extend(
        CollisionBody(held.object.name, held.link, held.object.pose, held.object.shapes)
        for held in attached
    )
    return bodies


def shapes_of(robot: RobotModel) -> dict[str, list[tuple[Collision, Pose]]]:
    """Return collisions by the link of the file, with their poses in its frame."""
    found: dict[str, list[tuple[Collision, Pose]]] = {name: [] for name in robot.links}
    for name, body in robot.bodies.items():
        for collision in body.link.collisions:
            owner = _owner(collision, name, robot)
            frame = robot.links[name].offset.inverse() * robot.links[owner].offset
            found[owner].append((collision, frame.inverse() * collision.pose))
    return found


def _owner(collision: Collision, link: str, robot: RobotModel) -> str:
    """Return the link of the file with a collision, where it was lumped into another's body."""
    element = collision.source.element if collision.source is not None else None
    match = _LINK.search(element or "")
    named = match.group(1) if match else link
    same = named in robot.links and robot.links[named].body == link
    return named if same else link
