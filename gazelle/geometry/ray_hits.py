"""Rays, which MuJoCo computes with its bounding volumes.

This is all that files need of the engine's library; they know nothing of the engine.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats
from gazelle.geometry.surface import WeldedSurface

_FEWEST = 4
"""Vertices that MuJoCo wants a mesh to have."""


def first_hits(
    surface: WeldedSurface, origins: Floats, directions: Floats
) -> tuple[Floats, NDArray[np.bool_]]:
    """Return distance along rays to the first triangle, and whether they come from behind it.

    Args:
        surface: Surface with triangles met from both sides.
        origins: [m], shape (n, 3); what is nearer than a hundred-thousandth of the size is
            not met.
        directions: Unit vectors, shape (n, 3).

    Returns:
        Distances [m], infinite where there is nothing, and whether the triangle looks away,
        both of shape (n,).
    """
    import mujoco
    from mujoco.batch import Batch

    spec = mujoco.MjSpec()
    scale = 1.0 / surface.size  # what is tiny has no area in MuJoCo
    lacking = max(0, _FEWEST - len(surface.vertices))
    vertices = np.concatenate([surface.vertices, surface.vertices[:1].repeat(lacking, axis=0)])
    middle = vertices.mean(axis=0)
    spec.add_mesh(
        name="mesh",
        uservert=((vertices - middle) * scale).ravel(),
        userface=surface.faces.astype(np.int32).ravel(),
        inertia=mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL,
    )
    spec.worldbody.add_geom(
        type=mujoco.mjtGeom.mjGEOM_MESH, meshname="mesh", contype=0, conaffinity=0
    )
    # What meets an edge exactly would pass between its two triangles.
    start = (origins - middle) * scale + 1e-5 * directions + 1e-6 * np.array([0.613, 0.371, 0.697])
    distance, _, normal = Batch(spec.compile(), 1).ray(start, directions, normal=True)
    met = distance[0] >= 0.0
    found = np.where(met, (distance[0] + 1e-5) / scale, np.inf)
    return found, met & (np.einsum("ij,ij->i", normal[0], directions) > 0.0)
