# cython: annotation_typing=False, infer_types=True
# mypy: disable-error-code="attr-defined, misc"
"""Poses and velocities of some bodies, set from arrays with a row each, or one row for all."""

from __future__ import annotations

import cython
import numpy as np
from cython.cimports.gazelle.engines.planar.bodies import Bodies
from cython.cimports.gazelle.engines.planar.columns import COS, SIN, YAW, X, Y, Z
from cython.cimports.gazelle.engines.planar.grid_cells import relink_one
from numpy.typing import ArrayLike

from gazelle.argument_checks import MOST
from gazelle.array_types import Floats, Indices
from gazelle.errors import EngineError
from gazelle.native.quaternion_rows import are_within


def rows_for(which: Indices, values: ArrayLike, width: int) -> Floats:
    """Return values with a row for each body, or one for all.

    Raises:
        EngineError: A number is not finite, or they have another shape.
    """
    given = np.asarray(values, np.float64)
    rows = given.reshape(1, -1) if given.ndim < 2 else given
    if rows.shape not in ((1, width), (len(which), width)):
        raise EngineError(f"values of shape {given.shape} are not for {len(which)} worlds")
    if not are_within(rows, MOST):
        raise EngineError(f"poses and velocities must be finite numbers, not {values!r:.60}")
    return rows


def set_poses(w: Bodies, which: Indices, pose: ArrayLike, height: ArrayLike | None = None) -> None:
    """Set poses of bodies, regardless of obstacles.

    Args:
        w: All bodies.
        which: Bodies, counted through all worlds, shape (n,).
        pose: x, y [m] and heading [rad], shape (3,), (1, 3) or (n, 3).
        height: Of their frames [m], shape (), (1,) or (n,); as it was if None.

    Raises:
        EngineError: A number is not finite, or they have another shape.
    """
    poses = rows_for(which, pose, 3)
    turned = np.empty((2, len(poses)))
    np.cos(poses[:, 2], out=turned[0])
    np.sin(poses[:, 2], out=turned[1])
    heights = np.zeros((0, 1))
    if height is not None:
        heights = rows_for(which, np.asarray(height, np.float64).reshape(-1, 1), 1)
    write_poses(w, which, poses, turned, heights)


def set_twists(w: Bodies, which: Indices, twist: ArrayLike) -> None:
    """Set commands and velocities of bodies, which do not stall.

    Args:
        w: All bodies.
        which: Bodies, counted through all worlds, shape (n,).
        twist: Along and across their headings [m/s], and turning [rad/s], shape (3,) or (n, 3).

    Raises:
        EngineError: A number is not finite, or they have another shape.
    """
    write_twists(w, which, rows_for(which, twist, 3))


def push(w: Bodies, which: Indices, linear: ArrayLike, angular: ArrayLike) -> None:
    """Set commands and velocities of bodies as ``set_twists``, from velocities in the world.

    Args:
        w: All bodies.
        which: Bodies, counted through all worlds, shape (n,).
        linear: [m/s], shape (3,) or (n, 3).
        angular: [rad/s], likewise.

    Raises:
        EngineError: A number is not finite, or they have another shape.
    """
    write_motion(w, which, rows_for(which, linear, 3), rows_for(which, angular, 3))


def write_poses(w: Bodies, which: Indices, pose: Floats, turned: Floats, height: Floats) -> None:
    """Write poses, cosines and sines of headings, and heights if there are any."""
    for i in range(which.shape[0]):
        b = which[i]
        k: cython.Py_ssize_t = i if pose.shape[0] > 1 else 0
        w.rows[b, X], w.rows[b, Y], w.rows[b, YAW] = pose[k, 0], pose[k, 1], pose[k, 2]
        w.rows[b, COS], w.rows[b, SIN] = turned[0, k], turned[1, k]
        if height.shape[0] > 0:
            w.rows[b, Z] = height[i if height.shape[0] > 1 else 0, 0]
        relink_one(w, b)


def write_twists(w: Bodies, which: Indices, twist: Floats) -> None:
    """Write commands and velocities."""
    for i in range(which.shape[0]):
        k = i if twist.shape[0] > 1 else 0
        drive(w, which[i], twist[k, 0], twist[k, 1], twist[k, 2])


def write_motion(w: Bodies, which: Indices, linear: Floats, angular: Floats) -> None:
    """Write commands and velocities, which are along the axes of the world."""
    for i in range(which.shape[0]):
        b, k = which[i], i if linear.shape[0] > 1 else 0
        cos, sin = w.rows[b, COS], w.rows[b, SIN]
        drive(
            w,
            b,
            cos * linear[k, 0] + sin * linear[k, 1],
            cos * linear[k, 1] - sin * linear[k, 0],
            angular[i if angular.shape[0] > 1 else 0, 2],
        )


def drive(w: Bodies, b: int, ahead: float, aside: float, turning: float) -> None:
    """Write command and velocity of one body."""
    w.command[b, 0] = w.velocity[b, 0] = ahead
    w.command[b, 1] = w.velocity[b, 1] = aside
    w.command[b, 2] = w.velocity[b, 2] = turning
    w.stalled[b] = 0


def rest_joints(worlds: Indices, angles: Floats, rates: Floats, targets: Floats) -> None:
    """Reset joints of some worlds, shape (n,), and their motors; tables have a row for each world.

    Where there is no motor, targets are not numbers, and that in all worlds.
    """
    for i in range(worlds.shape[0]):
        w = worlds[i]
        for k in range(angles.shape[1]):
            angles[w, k] = rates[w, k] = 0.0
            if targets[0, k] == targets[0, k]:
                targets[w, k] = 0.0
