"""Half-edges of triangles, and which of them run along one another.

Half-edge 3 f + i of face f runs from its corner i to the next. Where more than two faces meet at an
edge, as where bodies touch, those pair up that have matter between them: each body stays
closed by itself (Guéziec et al., "Cutting and stitching", IEEE Transactions on Visualization and
Computer Graphics 7, 2001).
"""

from __future__ import annotations

import numpy as np

from gazelle.array_types import Bools, Floats, Indices

_SAME = 1e-4
"""Angle between faces at an edge up to which they lie on one another [rad]."""


def half_edges(faces: Indices) -> Indices:
    """Return tail and head of each half-edge, shape (3 m, 2)."""
    return np.stack([faces.ravel(), np.roll(faces, -1, axis=1).ravel()], axis=1)


def edge_keys(one: Indices, other: Indices, count: int) -> Indices:
    """Return a number of each edge between two points of so many, the same both ways, shape (n,)."""
    keys: Indices = np.minimum(one, other) * np.int64(count) + np.maximum(one, other)
    return keys


def half_edge_twins(points: Floats, faces: Indices) -> Indices:
    """Return the half-edge that runs back along each, shape (3 m,); -1 if there is none.

    Args:
        points: [m], shape (n, 3).
        faces: Corners, shape (m, 3).
    """
    edges = half_edges(faces)
    order, starts, sizes = _by_edge(edges, len(points))
    twins = np.full(len(edges), -1)
    pairs = starts[sizes == 2]
    one, other = order[pairs], order[pairs + 1]
    back = edges[one, 0] != edges[other, 0]
    one, other = one[back], other[back]
    twins[one], twins[other] = other, one
    many = np.repeat(sizes > 2, sizes)
    if many.any():
        groups = np.repeat(np.arange(len(sizes)), sizes)
        _pair_around(points, faces, order[many], groups[many], twins)
    return twins


def unlike_neighbors(points: Floats, faces: Indices) -> Indices:
    """Return pairs of triangles at an edge of theirs alone that face opposite ways, shape (k, 2).

    Args:
        points: [m], shape (n, 3).
        faces: Corners, shape (m, 3).
    """
    edges = half_edges(faces)
    order, starts, sizes = _by_edge(edges, len(points))
    pairs = starts[sizes == 2]
    one, other = order[pairs], order[pairs + 1]
    alike = edges[one, 0] == edges[other, 0]
    return np.stack([one[alike], other[alike]], axis=1) // 3


def _by_edge(edges: Indices, count: int) -> tuple[Indices, Indices, Indices]:
    """Return half-edges sorted by their edges, and the start and size of each edge's run.

    Args:
        edges: Tail and head of each, shape (n, 2).
        count: Number of points.
    """
    keys = edge_keys(edges[:, 0], edges[:, 1], count)
    order = np.argsort(keys, kind="stable")
    starts = np.flatnonzero(np.diff(keys[order], prepend=-1))
    return order, starts, np.diff(np.append(starts, len(keys)))


def _pair_around(
    points: Floats, faces: Indices, rows: Indices, groups: Indices, twins: Indices
) -> None:
    """Write twins of half-edges along the same edge, through the matter between their faces.

    Args:
        points: [m], shape (n, 3).
        faces: Corners, shape (m, 3).
        rows: The half-edges, group by group.
        groups: The edge of each.
        twins: Twins of all half-edges; those of these are written.
    """
    edges = half_edges(faces)[rows]
    closing = edges[:, 0] < edges[:, 1]  # with growing angle matter ends there
    angles = _angles(points, faces, rows, groups, edges)
    order = np.lexsort((angles, groups))
    apart = np.diff(groups[order], prepend=-1) != 0
    apart |= np.diff(angles[order], prepend=0.0) > _SAME
    order = order[np.lexsort((~closing[order], np.cumsum(apart)))]
    rows, groups, closing = rows[order], groups[order], closing[order]
    while len(rows):
        after = _next_in_group(groups)
        opening = np.flatnonzero(~closing & closing[after])
        if not len(opening):
            break
        one, other = rows[opening], rows[after[opening]]
        twins[one], twins[other] = other, one
        left = twins[rows] < 0
        rows, groups, closing = rows[left], groups[left], closing[left]


def _angles(
    points: Floats, faces: Indices, rows: Indices, groups: Indices, edges: Indices
) -> Floats:
    """Return the angle of the face of each half-edge around its edge [rad].

    It is 0 at the first of each group.
    """
    low = points[edges.min(axis=1)]
    axes = points[edges.max(axis=1)] - low
    axes /= np.maximum(np.linalg.norm(axes, axis=1), 1e-300)[:, None]
    ways = points[faces.ravel()[rows - rows % 3 + (rows + 2) % 3]] - low
    ways -= np.einsum("ij,ij->i", ways, axes)[:, None] * axes
    _, first, inverse = np.unique(groups, return_index=True, return_inverse=True)
    zero = ways[first][inverse]
    cosines, sines = (np.einsum("ij,ij->i", ways, u) for u in (zero, np.cross(axes, zero)))
    angles: Floats = np.arctan2(sines, cosines) % (2.0 * np.pi)
    return np.where(angles > 2.0 * np.pi - _SAME, 0.0, angles)


def _next_in_group(groups: Indices) -> Indices:
    """Return the row after each, and after the last of a group its first."""
    after = np.arange(1, len(groups) + 1)
    last: Bools = np.diff(groups, append=-1) != 0
    ends = np.flatnonzero(last)
    after[ends] = np.concatenate([[0], ends[:-1] + 1])
    return after
