"""Rays, which MuJoCo computes with its bounding volumes.

This is all that files need of the engine's library; they know nothing of the engine.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats
from gazelle.geometry.bounding_volumes import tighten_hierarchies
from gazelle.geometry.surface import WeldedSurface

_FEWEST = 4
"""Vertices that MuJoCo wants a mesh to have."""


class SurfaceRays:
    """Rays against the triangles of a surface, which are met from both sides.

    Args:
        surface: Any triangles, at least one.
    """

    def __init__(self, surface: WeldedSurface) -> None:
        import mujoco
        from mujoco.batch import Batch

        spec = mujoco.MjSpec()
        self._scale = 1.0 / surface.size  # what is tiny has no area in MuJoCo
        lacking = max(0, _FEWEST - len(surface.vertices))
        vertices = np.concatenate([surface.vertices, surface.vertices[:1].repeat(lacking, axis=0)])
        self._middle = vertices.mean(axis=0)
        spec.add_mesh(
            name="mesh",
            uservert=((vertices - self._middle) * self._scale).ravel(),
            userface=surface.faces.astype(np.int32).ravel(),
            inertia=mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL,
        )
        spec.worldbody.add_geom(
            type=mujoco.mjtGeom.mjGEOM_MESH, meshname="mesh", contype=0, conaffinity=0
        )
        model = spec.compile()
        tighten_hierarchies(model)
        self._batch = Batch(model, 1)

    def first_hits(self, origins: Floats, directions: Floats) -> tuple[Floats, NDArray[np.bool_]]:
        """Return distance along rays to the first triangle, and whether they come from behind it.

        Args:
            origins: [m], shape (n, 3); what is nearer than a hundred-thousandth of the size is
                not met.
            directions: Unit vectors, shape (n, 3).

        Returns:
            Distances [m], infinite where there is nothing, and whether the triangle looks away,
            both of shape (n,).
        """
        # What meets an edge exactly would pass between its two triangles.
        nudge = 1e-5 * directions + 1e-6 * np.array([0.613, 0.371, 0.697])
        start = (origins - self._middle) * self._scale + nudge
        distance, _, normal = self._batch.ray(start, directions, normal=True)
        met = distance[0] >= 0.0
        found = np.where(met, (distance[0] + 1e-5) / self._scale, np.inf)
        return found, met & (np.einsum("ij,ij->i", normal[0], directions) > 0.0)
