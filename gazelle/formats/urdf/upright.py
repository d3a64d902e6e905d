"""Rotations as urdfdom turns them into angles, in the conversion from URDF for Gazebo."""

from __future__ import annotations

import math

from gazelle.description import Pose

_STEEP = 0.99999


def upright(pose: Pose) -> Pose:
    """Return the pose; a pitch within 0.26 degrees of a right angle becomes one.

    That is what ``urdf::Rotation::getRPY`` does, by which libsdformat writes the poses of
    collisions, visuals and lumped sensors: a pitch of 1.57 stands upright in Gazebo.
    """
    x, y, z, w = pose.quaternion
    sine = 2.0 * (w * y - x * z)
    if abs(sine) < _STEEP:
        return pose
    sign = math.copysign(1.0, sine)
    yaw = 2.0 * math.atan2(-sign * x, sign * y)
    return Pose(*pose.position, 0.0, sign * math.pi / 2, yaw)
