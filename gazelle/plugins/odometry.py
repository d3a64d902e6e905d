"""Odometry from a model's true motion, as most of Gazebo's drives publish it."""

from __future__ import annotations

from gazelle.rotations import conjugate, rotate
from gazelle.simulation import Odometry, Robot, Transform, Transforms
from gazelle.simulation.values import SixNumbers

POSE_VARIANCE: SixNumbers = (1e-5, 1e-5, 1e12, 1e12, 1e12, 1e-3)
"""Of planar bases that are sure of x, y and yaw."""


def true_odometry(
    robot: Robot,
    frame: str,
    child_frame: str,
    pose_variance: SixNumbers = POSE_VARIANCE,
    twist_variance: SixNumbers = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
) -> Odometry:
    """The model's pose in the world, and its velocity in its own axes."""
    place, motion = robot.placement(), robot.motion()
    back = conjugate(place.quaternion)
    return Odometry(
        robot.simulation.clock.now_ns,
        frame,
        child_frame,
        place.position,
        place.quaternion,
        rotate(back, motion.linear),
        rotate(back, motion.angular),
        pose_variance,
        twist_variance,
    )


def as_transforms(odometry: Odometry) -> Transforms:
    """The same pose as a frame of tf."""
    place = Transform(odometry.frame, odometry.child_frame, odometry.position, odometry.quaternion)
    return Transforms(odometry.stamp, (place,))
