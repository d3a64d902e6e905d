# mypy: disallow-untyped-decorators=False, disable-error-code="attr-defined, misc, no-any-return"
"""Poses of bodies in space."""

from __future__ import annotations

import cython
import numpy as np
from cython.cimports.gazelle.engines.planar.bodies import Bodies
from cython.cimports.gazelle.engines.planar.columns import YAW, X, Y, Z
from cython.cimports.gazelle.native.elementary import cos, sin

from gazelle.array_types import Floats, Indices
from gazelle.description.pose import Quaternion, Vector3


def pose_of(bodies: Bodies, row: cython.Py_ssize_t, lean: Quaternion) -> tuple[Vector3, Quaternion]:
    """Return position and quaternion of one body, to the bit those of ``poses_of``.

    Args:
        bodies: Of all worlds.
        row: Its row.
        lean: Turn before its heading.

    Raises:
        IndexError: There is no such row.
    """
    if not 0 <= row < bodies.rows.shape[0]:
        raise IndexError(row)
    q = turn(bodies.rows[row, YAW], lean[0], lean[1], lean[2], lean[3])
    place = bodies.rows[row, X], bodies.rows[row, Y], bodies.rows[row, Z]
    return place, (q[0], q[1], q[2], q[3])


def poses_of(bodies: Bodies, rows: Indices, leans: Floats) -> tuple[Floats, Floats]:
    """Return positions, shape (n, 3), and quaternions, shape (n, 4), of bodies.

    Args:
        bodies: Of all worlds.
        rows: Their rows, shape (n,).
        leans: Turns before their headings, shape (leans, 4); their number divides n.

    Raises:
        IndexError: There is no such row.
    """
    which: cython.Py_ssize_t[::1] = rows
    lean: cython.double[:, ::1] = leans
    count = which.shape[0]
    positions, quaternions = np.empty((count, 3)), np.empty((count, 4))
    p: cython.double[:, ::1] = positions
    q: cython.double[:, ::1] = quaternions
    for i in range(count):
        b = which[i]
        if not 0 <= b < bodies.rows.shape[0]:
            raise IndexError(b)
        k = i % lean.shape[0]
        p[i, 0], p[i, 1], p[i, 2] = bodies.rows[b, X], bodies.rows[b, Y], bodies.rows[b, Z]
        t = turn(bodies.rows[b, YAW], lean[k, 0], lean[k, 1], lean[k, 2], lean[k, 3])
        q[i, 0], q[i, 1], q[i, 2], q[i, 3] = t[0], t[1], t[2], t[3]
    return positions, quaternions


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def turn(
    yaw: cython.double, x: cython.double, y: cython.double, z: cython.double, w: cython.double
) -> tuple[cython.double, cython.double, cython.double, cython.double]:
    """Return the quaternion of a turn and then a heading."""
    s = sin(0.5 * yaw)
    c = cos(0.5 * yaw)
    return c * x - s * y, c * y + s * x, c * z + s * w, c * w - s * z
