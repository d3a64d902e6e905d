"""Meshes that are ground: one height over each place of a rectangle, as a grid of heights."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gazelle.array_types import Floats
from gazelle.geometry.mesh_data import MeshData
from gazelle.geometry.surface import WeldedSurface, clean

FEWEST = 4000
"""Least triangles of a mesh that is checked for ground; fewer collide as they are."""

_MOST_NODES = 250_000
_EDGE = 1e-5
"""Distance by which nodes on the rim are moved inwards, as a share of the size."""
_COVERED = 1e-3
"""Share of the rectangle that may not be covered, or covered twice."""


@dataclass(frozen=True, slots=True)
class Ground:
    """Heights over a level rectangle.

    Attributes:
        heights: [m], shape (rows, columns); rows along y, columns along x, from the least on.
        low: Least x, y [m].
        high: Greatest x, y [m].
        gaps: Largest distance of the mesh from the heights [m], if each cell is split from its
            corner (0, 0) to (1, 1), and if it is split from (1, 0) to (0, 1).
    """

    heights: Floats
    low: tuple[float, float]
    high: tuple[float, float]
    gaps: tuple[float, float]


def ground_of(mesh: MeshData) -> Ground | None:
    """Return the heights of a mesh; None if it has few triangles, or is not ground."""
    if len(mesh.faces) < FEWEST:
        return None
    if not _one_sided(mesh):
        return None
    surface = clean(mesh.vertices, mesh.faces)
    low, high = surface.vertices.min(axis=0), surface.vertices.max(axis=0)
    span = high - low
    up = surface.normals[:, 2]
    area = float((surface.areas * np.abs(up)).sum())
    level = bool((up > 0.0).all() or (up < 0.0).all())
    if not level or abs(area - span[0] * span[1]) > _COVERED * area:
        return None
    columns, rows = _nodes(surface, span)
    x, y = np.meshgrid(np.linspace(low[0], high[0], columns), np.linspace(low[1], high[1], rows))
    inset = _EDGE * surface.size
    start = np.stack(
        [
            np.clip(x, low[0] + inset, high[0] - inset).ravel(),
            np.clip(y, low[1] + inset, high[1] - inset).ravel(),
            np.full(x.size, high[2] + 0.1 * surface.size),
        ],
        axis=1,
    )
    distance, _ = surface.rays.first_hits(start, np.broadcast_to([0.0, 0.0, -1.0], start.shape))
    if not np.isfinite(distance).all():
        return None
    heights = (start[:, 2] - distance).reshape(rows, columns)
    places = np.concatenate([surface.vertices, surface.vertices[surface.faces].mean(axis=1)])
    at = (places[:, :2] - low[:2]) / span[:2] * [columns - 1, rows - 1]
    gaps = [float(np.abs(each - places[:, 2]).max()) for each in _between(heights, at)]
    corner, end = (float(low[0]), float(low[1])), (float(high[0]), float(high[1]))
    return Ground(heights, corner, end, (gaps[0], gaps[1]))


def _one_sided(mesh: MeshData) -> bool:
    """Return whether no two triangles clearly face up and down: a quick first test."""
    (ax, ay), (bx, by), (cx, cy) = (mesh.vertices[mesh.faces[:, i], :2].T for i in range(3))
    up = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    least = 1e-6 * float(np.abs(up).max())
    return not bool((up > least).any() and (up < -least).any())


def _nodes(surface: WeldedSurface, span: Floats) -> tuple[int, int]:
    """Return columns and rows: those of the mesh if it is a grid, else as many as there may be."""
    places = np.round((surface.vertices[:, :2] - surface.vertices[:, :2].min(axis=0)) / span[:2], 6)
    columns, rows = len(np.unique(places[:, 0])), len(np.unique(places[:, 1]))
    if columns * rows == len(surface.vertices) and columns * rows <= 4 * _MOST_NODES:
        return columns, rows
    cell = float(np.sqrt(span[0] * span[1] / _MOST_NODES))
    return max(2, int(span[0] / cell) + 1), max(2, int(span[1] / cell) + 1)


def _between(heights: Floats, at: Floats) -> tuple[Floats, Floats]:
    """Return heights at places in units of cells, shape (n, 2), for both ways to split cells."""
    rows, columns = heights.shape
    column = np.minimum(at[:, 0].astype(np.intp), columns - 2)
    row = np.minimum(at[:, 1].astype(np.intp), rows - 2)
    u, v = at[:, 0] - column, at[:, 1] - row
    a, b = heights[row, column], heights[row, column + 1]
    c, d = heights[row + 1, column], heights[row + 1, column + 1]
    straight = np.where(u > v, a + u * (b - a) + v * (d - b), a + v * (c - a) + u * (d - c))
    across = np.where(
        u + v < 1.0,
        a + u * (b - a) + v * (c - a),
        d + (1.0 - u) * (c - d) + (1.0 - v) * (b - d),
    )
    return straight, across
