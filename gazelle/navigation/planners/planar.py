"""Poses in the plane: from one frame to another."""

from __future__ import annotations

import math

import numpy as np

from gazelle.array_types import Floats
from gazelle.navigation.angles import wrapped
from gazelle.navigation.following import Pose2


def composed(first: Pose2, second: Pose2) -> Pose2:
    """Return ``second``, given in the frame of ``first``, in the parent frame of ``first``."""
    cos, sin = math.cos(first[2]), math.sin(first[2])
    return (
        first[0] + cos * second[0] - sin * second[1],
        first[1] + sin * second[0] + cos * second[1],
        wrapped(first[2] + second[2]),
    )


def inverse(pose: Pose2) -> Pose2:
    """Return the pose of the frame that a pose is in, in the frame of the pose."""
    cos, sin = math.cos(pose[2]), math.sin(pose[2])
    return (-cos * pose[0] - sin * pose[1], sin * pose[0] - cos * pose[1], -pose[2])


def between(first: Pose2, second: Pose2) -> Pose2:
    """Return ``second`` in the frame of ``first``, both in the same one."""
    return composed(inverse(first), second)


def moved(poses: Floats, frame: Pose2) -> Floats:
    """Return poses or points of a frame in its parent frame, shape (n, 2) or (n, 3)."""
    cos, sin = math.cos(frame[2]), math.sin(frame[2])
    result = np.array(poses, np.float64)
    result[:, 0] = frame[0] + cos * poses[:, 0] - sin * poses[:, 1]
    result[:, 1] = frame[1] + sin * poses[:, 0] + cos * poses[:, 1]
    if result.shape[1] > 2:
        result[:, 2] += frame[2]
    return result
