"""How MuJoCo may find the frame of a mesh."""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np

SHELL = mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL
"""From its surface, which any mesh has."""
_FLAT = 1e-3
"""Thickness over length below which a mesh counts as a sheet."""
_TINY = 2e-3
"""Length below which MuJoCo finds the volume of a mesh too small [m]."""


def inertia_of(vertices: Any) -> mujoco.mjtMeshInertia:
    """What it goes by: a mesh as thin as a sheet has no volume to go by."""
    spans = np.linalg.svd(vertices - vertices.mean(axis=0), compute_uv=False)
    flat = spans[-1] < _FLAT * spans[0] or np.ptp(vertices, axis=0).max() < _TINY
    return SHELL if flat else mujoco.mjtMeshInertia.mjMESH_INERTIA_CONVEX
