"""Inertia tensors as MuJoCo has them: principal moments and axes."""

from __future__ import annotations

import mujoco
import numpy as np

from gazelle.array_types import Floats


def principal(tensors: Floats) -> tuple[Floats, Floats]:
    """Moments, shape (n, 3), and axes (w, x, y, z), shape (n, 4), of tensors, shape (n, 3, 3).

    A rigid body's moments obey a + b >= c; the smaller ones are raised just enough.
    """
    moments, axes = np.linalg.eigh(tensors)
    lack = moments[:, 2] - moments[:, 0] - moments[:, 1]
    moments[:, :2] += np.maximum(lack, 0.0)[:, None] / 2.0 * (1.0 + 1e-9)
    axes[np.linalg.det(axes) < 0.0, :, 0] *= -1.0
    quaternions = np.zeros((len(tensors), 4))
    for quaternion, matrix in zip(quaternions, axes, strict=True):
        mujoco.mju_mat2Quat(quaternion, matrix.ravel())
    return moments, quaternions


def tensor(moments: Floats, quaternion: Floats) -> Floats:
    """The tensor (xx, yy, zz, xy, xz, yz) of moments, (3,), about axes (w, x, y, z)."""
    matrix = np.zeros(9)
    mujoco.mju_quat2Mat(matrix, quaternion)
    axes = matrix.reshape(3, 3)
    full = axes @ np.diag(moments) @ axes.T
    return np.array([full[0, 0], full[1, 1], full[2, 2], full[0, 1], full[0, 2], full[1, 2]])


def matrices(values: Floats) -> Floats:
    """Tensors (xx, yy, zz, xy, xz, yz), shape (n, 6), as matrices, shape (n, 3, 3)."""
    rows = [[0, 3, 4], [3, 1, 5], [4, 5, 2]]
    full: Floats = values[:, rows]
    return full
