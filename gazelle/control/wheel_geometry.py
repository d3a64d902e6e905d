"""Sizes of a base from its URDF."""

from __future__ import annotations

import math

from gazelle.description import Cylinder, Joint, Link, Model, Sphere, Vector3
from gazelle.errors import ControlError, did_you_mean


def wheel_distance(model: Model | None, first: str, second: str) -> float:
    """Return the distance between the origins of two joints [m].

    Raises:
        ControlError: There is no URDF, or no such joint in it.
    """
    return math.dist(joint_origin(model, first), joint_origin(model, second))


def joint_origin(model: Model | None, joint: str) -> Vector3:
    """Return the position of a joint in the model's frame [m].

    Raises:
        ControlError: There is no URDF, or no such joint in it.
    """
    found, child = _find(model, joint)
    return (child.pose * found.pose).position


def wheel_radius(
    model: Model | None, joint: str, shapes: tuple[type[Cylinder | Sphere], ...] = (Cylinder,)
) -> float:
    """Return the radius of the wheel on a joint: of the first collision of its link [m].

    Args:
        model: The robot.
        joint: Of the wheel.
        shapes: Allowed shapes of a wheel: of ros_controllers only diff_drive_controller knows spheres.

    Raises:
        ControlError: There is no URDF, or no such joint in it, or the wheel is of another shape.
    """
    _, child = _find(model, joint)
    shape = child.collisions[0].geometry if child.collisions else None
    if not isinstance(shape, shapes):
        what = "no collision" if shape is None else f"a {type(shape).__name__.lower()}"
        raise ControlError(
            f"couldn't retrieve the radius of the wheel '{child.name}' on '{joint}': it has {what}",
            hint="set the parameter wheel_radius, or make its first collision a "
            + " or ".join(each.__name__.lower() for each in shapes),
        )
    return shape.radius


def _find(model: Model | None, name: str) -> tuple[Joint, Link]:
    if model is None:
        raise ControlError(
            "the robot's description is not known, and sizes of the base are missing",
            hint="set wheel_separation, wheel_radius and so on, or robot_description",
        )
    known: list[str] = []
    for placed in model.walk():
        links = {link.name: link for link in placed.model.links}
        for joint in placed.model.joints:
            known.append(joint.name)
            if joint.name == name and joint.child in links:
                return joint, links[joint.child]
    raise ControlError(
        f"joint '{name}' couldn't be retrieved from the model description",
        hint=did_you_mean(name, known),
    )
