"""Constraints of ``moveit_msgs`` as those that planning knows."""

from __future__ import annotations

from typing import Any

from gazelle.array_types import Floats
from gazelle.bridges.conversions import point, quaternion
from gazelle.bridges.moveit.frames import PlanningFrames, pose_of_message
from gazelle.description import Box, Cylinder, Pose, Sphere
from gazelle.planning import (
    ConstraintSet,
    JointConstraint,
    NoPlanError,
    OrientationConstraint,
    PlanOutcome,
    PositionConstraint,
)
from gazelle.planning.constraints import Region

_BOX, _SPHERE, _CYLINDER = 1, 2, 3
_ROTATION_VECTOR = 1


def constraints_of_message(message: Any, frames: PlanningFrames, state: Floats) -> ConstraintSet:
    """A ``moveit_msgs/Constraints``.

    Args:
        message: The constraints.
        frames: What their frames are.
        state: Where the robot is: frames may move with it. Shape (variables,).

    Raises:
        NoPlanError: A frame is not known, or a constraint is of a kind that is not planned for.
    """
    if message.visibility_constraints:
        _refuse("constraints of visibility are not planned for")
    return ConstraintSet(
        tuple(
            JointConstraint(each.joint_name, each.position, each.tolerance_above, each.tolerance_below)
            for each in message.joint_constraints
        ),
        tuple(_position(each, frames, state) for each in message.position_constraints),
        tuple(_orientation(each, frames, state) for each in message.orientation_constraints),
        message.name,
    )  # fmt: skip


def _position(message: Any, frames: PlanningFrames, state: Floats) -> PositionConstraint:
    region = message.constraint_region
    if region.meshes or len(region.primitives) != 1 or len(region.primitive_poses) != 1:
        _refuse(
            f"the region for link '{message.link_name}' is {len(region.primitives)} shapes at "
            f"{len(region.primitive_poses)} poses and {len(region.meshes)} meshes, not one shape"
        )
    base = frames.find(message.header.frame_id, state)
    return PositionConstraint(
        message.link_name,
        _region(region.primitives[0]),
        base * pose_of_message(region.primitive_poses[0]),
        point(message.target_point_offset),
    )


def _region(primitive: Any) -> Region:
    lengths = tuple(primitive.dimensions)
    if primitive.type == _BOX and len(lengths) == 3:
        return Box((lengths[0], lengths[1], lengths[2]))
    if primitive.type == _SPHERE and len(lengths) == 1:
        return Sphere(lengths[0])
    if primitive.type == _CYLINDER and len(lengths) == 2:
        return Cylinder(radius=lengths[1], length=lengths[0])
    raise NoPlanError(
        f"a region of type {primitive.type} with {len(lengths)} lengths is not known",
        PlanOutcome.INVALID_GOAL_CONSTRAINTS,
        "boxes have three, spheres one, cylinders height and radius",
    )


def _orientation(message: Any, frames: PlanningFrames, state: Floats) -> OrientationConstraint:
    base = frames.find(message.header.frame_id, state)
    turned = base * Pose.from_quaternion((0, 0, 0), quaternion(message.orientation))
    tolerances = (
        message.absolute_x_axis_tolerance,
        message.absolute_y_axis_tolerance,
        message.absolute_z_axis_tolerance,
    )
    by_vector = message.parameterization == _ROTATION_VECTOR
    return OrientationConstraint(
        message.link_name, turned, tolerances, "rotation vector" if by_vector else "euler"
    )


def _refuse(text: str) -> None:
    raise NoPlanError(text, PlanOutcome.INVALID_GOAL_CONSTRAINTS)
