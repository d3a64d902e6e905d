"""Meshes of shapes that MuJoCo lacks, and how it finds the frame of a mesh."""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats
from gazelle.description import Cone

_SIDES = 24


def cone_mesh(shape: Cone) -> tuple[Floats, NDArray[np.int64]]:
    """Return vertices [m], (n, 3), and faces, (m, 3), of a cone along z about its middle."""
    angles = np.arange(_SIDES) * (2.0 * np.pi / _SIDES)
    rim = np.stack(
        (
            shape.radius * np.cos(angles),
            shape.radius * np.sin(angles),
            np.full(_SIDES, -shape.length / 2),
        ),
        axis=1,
    )
    vertices = np.vstack((rim, (0.0, 0.0, shape.length / 2), (0.0, 0.0, -shape.length / 2)))
    after = np.roll(np.arange(_SIDES), -1)
    here = np.arange(_SIDES)
    apex, centre = np.full(_SIDES, _SIDES), np.full(_SIDES, _SIDES + 1)
    faces = np.vstack((np.stack((here, after, apex), 1), np.stack((after, here, centre), 1)))
    return vertices, faces


SHELL = mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL
"""From its surface, which any mesh has."""
_FLAT = 1e-3
"""Thickness over length below which a mesh counts as a sheet."""
_TINY = 2e-3
"""Length below which MuJoCo finds the volume of a mesh too small [m]."""


def inertia_of(vertices: Any) -> mujoco.mjtMeshInertia:
    """Return the kind of inertia: a mesh as thin as a sheet has no volume to use."""
    spans = np.linalg.svd(vertices - vertices.mean(axis=0), compute_uv=False)
    flat = spans[-1] < _FLAT * spans[0] or np.ptp(vertices, axis=0).max() < _TINY
    return SHELL if flat else mujoco.mjtMeshInertia.mjMESH_INERTIA_CONVEX
