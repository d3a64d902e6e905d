"""Constraints of ``moveit_msgs`` as those that planning knows."""

from __future__ import annotations

from gazelle.array_types import Floats
from gazelle.bridges.conversions import point, pose_of_message, quaternion
from gazelle.bridges.moveit.frames import PlanningFrames
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
from gazelle_ros.msgs import moveit_msgs, shape_msgs

_BOX, _SPHERE, _CYLINDER = 1, 2, 3
_ROTATION_VECTOR = 1
_NO_WEIGHT = 2.3e-16


def constraints_of_message(
    message: moveit_msgs.msg.Constraints, frames: PlanningFrames, state: Floats
) -> ConstraintSet:
    """Convert a ``moveit_msgs/Constraints``.

    Args:
        message: The constraints.
        frames: Their frames.
        state: State of the robot, with which frames may move. Shape (variables,).

    Raises:
        NoPlanError: A frame is not known, or a constraint is of a kind that is not planned for.
    """
    if message.visibility_constraints:
        _refuse("visibility constraints are not supported")
    return ConstraintSet(
        tuple(
            JointConstraint(each.joint_name, each.position, each.tolerance_above, each.tolerance_below)
            for each in message.joint_constraints
        ),
        tuple(_position(each, frames, state) for each in message.position_constraints),
        tuple(_orientation(each, frames, state) for each in message.orientation_constraints),
        message.name,
    )  # fmt: skip


def _position(
    message: moveit_msgs.msg.PositionConstraint, frames: PlanningFrames, state: Floats
) -> PositionConstraint:
    region = message.constraint_region
    count = len(region.primitives)
    if region.meshes or not count or len(region.primitive_poses) != count:
        _refuse(
            f"the region for link '{message.link_name}' is {count} shapes at "
            f"{len(region.primitive_poses)} poses and {len(region.meshes)} meshes; it needs one "
            "pose for each shape, and no meshes"
        )
    base = frames.find(message.header.frame_id, state)
    parts = [
        (_region(shape), base * pose_of_message(pose))
        for shape, pose in zip(region.primitives, region.primitive_poses, strict=True)
    ]
    (shape, pose), *others = parts
    offset = point(message.target_point_offset)
    return PositionConstraint(message.link_name, shape, pose, offset, tuple(others))


def _region(primitive: shape_msgs.msg.SolidPrimitive) -> Region:
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


def _orientation(
    message: moveit_msgs.msg.OrientationConstraint, frames: PlanningFrames, state: Floats
) -> OrientationConstraint:
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


def weights_of_message(message: moveit_msgs.msg.Constraints) -> list[float]:
    """Return weights of a ``Constraints``, in the order of a ``ConstraintSet``; 1 by default."""
    parts = (
        message.joint_constraints,
        message.position_constraints,
        message.orientation_constraints,
    )
    weights = [float(each.weight) for kind in parts for each in kind]
    return [weight if weight > _NO_WEIGHT else 1.0 for weight in weights]


def _refuse(text: str) -> None:
    raise NoPlanError(text, PlanOutcome.INVALID_GOAL_CONSTRAINTS)
