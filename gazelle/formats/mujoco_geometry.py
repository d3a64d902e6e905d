"""Hulls and rays, computed by MuJoCo: its Qhull, and its bounding volumes.

This is all that files need of the engine's library; they know nothing of the engine.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, Indices
from gazelle.formats.hull import convex_hull
from gazelle.formats.surface import Surface

Solid = tuple[Floats, NDArray[np.int32]]
"""Vertices, shape (n, 3), and faces, shape (m, 3)."""

_FEWEST = 4
"""Vertices that MuJoCo wants a mesh to have."""


def first_hits(
    surface: Surface, origins: Floats, directions: Floats
) -> tuple[Floats, NDArray[np.bool_]]:
    """Distance along rays to the first triangle, and whether they come from behind it.

    Args:
        surface: Whose triangles are met from both sides.
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


def hulls_of(clouds: Sequence[Floats]) -> list[Solid]:
    """Corners and faces of the hulls of points, shapes (n, 3); those in a plane are left out."""
    return [hull for hull in each_hull_of(clouds) if hull is not None]


def each_hull_of(clouds: Sequence[Floats]) -> list[Solid | None]:
    """Corners and faces of the hull of each of some points; None if they are in a plane.

    MuJoCo's Qhull makes them all at once; where it gives up on one, each is made here.
    """
    if not clouds:
        return []
    import mujoco

    spec = mujoco.MjSpec()
    for number, points in enumerate(clouds):
        size = max(float(np.ptp(points, axis=0).max()), 1e-300)
        spec.add_mesh(name=str(number), uservert=((points - points[0]) / size).ravel())
        spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_MESH, meshname=str(number))
    try:
        model = spec.compile()
    except ValueError:
        if len(clouds) > 1:  # the others need not wait for the one
            return [each_hull_of([points])[0] for points in clouds]
        hull = convex_hull(clouds[0], 1e-6 * _size(clouds[0]))
        return [None if hull is None else _used(clouds[0], hull.faces)]
    return [_used(points, _graph_faces(model, row)) for row, points in enumerate(clouds)]


def _graph_faces(model: Any, mesh: int) -> Indices:
    """Faces of a mesh's hull in a MuJoCo model, which calls the list of its parts a graph."""
    graph = model.mesh_graph[model.mesh_graphadr[mesh] :]
    vertices, faces = int(graph[0]), int(graph[1])
    start = 2 + 3 * vertices + 3 * faces
    rows: Indices = graph[start : start + 3 * faces].reshape(-1, 3).astype(np.intp)
    return rows


def _size(points: Floats) -> float:
    return float(np.linalg.norm(np.ptp(points, axis=0)))


def _used(points: Floats, faces: Indices) -> tuple[Floats, NDArray[np.int32]]:
    rows, inverse = np.unique(faces, return_inverse=True)
    return points[rows], inverse.reshape(-1, 3).astype(np.int32)
