"""Inertia tensors as MuJoCo has them: principal moments and axes.

The moments of a rigid body obey a + b >= c. Files break that by rounding or by guess-work, and ODE
simulates such inertias as they are, for the equations of motion only want them positive. MuJoCo's
compiler refuses them, its steps do not.
"""

from __future__ import annotations

from collections.abc import Iterable

import mujoco
import numpy as np

from gazelle.array_types import Floats
from gazelle.description import Inertial
from gazelle.engines.mujoco.compiler.unsupported import LEAST_MOMENT
from gazelle.errors import EngineError
from gazelle.formats.limits import HEAVIEST
from gazelle.kinematics.tree import TreeLink

_ROUNDING = 1e-9
"""Relative error of moments that is not worth a second compilation."""


def principal(tensors: Floats) -> tuple[Floats, Floats]:
    """Return moments, shape (n, 3), and axes (w, x, y, z) of tensors, shape (n, 3, 3)."""
    moments, axes = np.linalg.eigh(tensors)
    axes[np.linalg.det(axes) < 0.0, :, 0] *= -1.0
    quaternions = np.zeros((len(tensors), 4))
    for quaternion, matrix in zip(quaternions, axes, strict=True):
        mujoco.mju_mat2Quat(quaternion, matrix.ravel())
    return moments, quaternions


def possible(moments: Floats) -> Floats:
    """Return moments in ascending order, (3,), the smaller ones raised just enough to be valid."""
    lack = max(0.0, moments[2] - moments[0] - moments[1])
    raised: Floats = moments + lack / 2.0 * (1.0 + 1e-9) * np.array((1.0, 1.0, 0.0))
    return raised


def inertia_of(body: TreeLink) -> tuple[Floats, Floats]:
    """Return a link's moments, (3,), and axes (w, x, y, z), (4,).

    Raises:
        EngineError: The inertia is not positive definite, or too large.
    """
    inertial = body.link.inertial or Inertial()
    if not (inertial.mass <= HEAVIEST and (np.abs(inertial.inertia.matrix()) <= HEAVIEST).all()):
        raise EngineError(
            f"link '{body.name}' has a mass or a moment of inertia beyond the limit of "
            f"{HEAVIEST:g} kg or kg m²",
            source=inertial.source or body.link.source,
        )
    rotation = inertial.pose.matrix()[:3, :3]
    moments, axes = principal((rotation @ inertial.inertia.matrix() @ rotation.T)[None])
    if moments[0, 0] <= 0.0:
        raise EngineError(
            f"link '{body.name}' has an inertia that is not positive definite "
            f"(principal moments {', '.join(f'{m:.3g}' for m in moments[0])} kg m²)",
            source=inertial.source or body.link.source,
        )
    return np.maximum(moments[0], LEAST_MOMENT), axes[0]


def restore_inertias(model: mujoco.MjModel, bodies: Iterable[TreeLink]) -> None:
    """Restore the file's moments of links with compiled ones that had to be raised."""
    changed = False
    for body in bodies:
        found = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, body.name)
        if body.root in {"kinematic", "static"} or found <= 0:
            continue
        moments, _ = inertia_of(body)
        if possible(moments)[0] > moments[0] + _ROUNDING * moments[2]:
            model.body_inertia[found] = moments
            changed = True
    if changed:
        mujoco.mj_setConst(model, mujoco.MjData(model))


def tensor(moments: Floats, quaternion: Floats) -> Floats:
    """Return the tensor (xx, yy, zz, xy, xz, yz) of moments, (3,), about axes (w, x, y, z)."""
    matrix = np.zeros(9)
    mujoco.mju_quat2Mat(matrix, quaternion)
    axes = matrix.reshape(3, 3)
    full = axes @ np.diag(moments) @ axes.T
    return np.array([full[0, 0], full[1, 1], full[2, 2], full[0, 1], full[0, 2], full[1, 2]])


def matrices(values: Floats) -> Floats:
    """Return tensors (xx, yy, zz, xy, xz, yz), shape (n, 6), as matrices, shape (n, 3, 3)."""
    rows = [[0, 3, 4], [3, 1, 5], [4, 5, 2]]
    full: Floats = values[:, rows]
    return full
