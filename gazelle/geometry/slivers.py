"""Triangles without a width, which exporters put where several corners lie on one line.

Left out, they leave the surface open: the edges beside them have no twin. Their longest edge is
flipped instead, so that the triangle behind it is divided at the corner that lies on it.
"""

from __future__ import annotations

import numpy as np

from gazelle.array_types import Bools, Floats, Indices
from gazelle.geometry.half_edges import edge_keys, half_edge_twins, half_edges

_ROUNDS = 20
"""Rounds of flips; each corner of several on one line takes one."""


def flip_slivers(points: Floats, faces: Indices, width: float) -> Indices:
    """Return triangles of the same surface, fewer of which are narrower than a width.

    Triangles that share their longest edge with none stay.

    Args:
        points: [m], shape (n, 3).
        faces: Corners, shape (m, 3).
        width: Height over the longest edge up to which a triangle is a sliver [m].
    """
    faces = faces.copy()
    for _ in range(_ROUNDS):
        heights, longest = _heights(points, faces)
        slivers = np.flatnonzero(heights <= width)
        if not len(slivers):
            break
        twins = half_edge_twins(points, faces)
        back = twins[3 * slivers + longest[slivers]]
        slivers, back = slivers[back >= 0], back[back >= 0]
        if not len(back) or not _flip(points, faces, slivers, longest[slivers], back, width):
            break
    return faces


def _flip(
    points: Floats,
    faces: Indices,
    slivers: Indices,
    longest: Indices,
    back: Indices,
    width: float,
) -> bool:
    """Flip edges between slivers and other triangles; return whether there were any.

    Of two slivers shorter ones come, which lie at other triangles.
    """
    other, side = back // 3, back % 3
    a, b, c = (faces[slivers, (longest + i) % 3] for i in range(3))
    d = faces[other, (side + 2) % 3]
    new = np.stack([np.stack([a, d, c], axis=1), np.stack([d, b, c], axis=1)], axis=1)
    least = _heights(points, new.reshape(-1, 3))[0].reshape(-1, 2).min(axis=1)
    before, behind = (_heights(points, faces[rows])[0] for rows in (slivers, other))
    along = np.linalg.norm(points[b] - points[a], axis=1)
    ends = np.linalg.norm(points[np.stack([a, a, b, b])] - points[np.stack([c, d, c, d])], axis=2)
    shorter = (behind <= width) & (ends.max(axis=0) < along)
    edges = half_edges(faces)
    keys = edge_keys(edges[:, 0], edges[:, 1], len(points))
    taken = _among(edge_keys(c, d, len(points)), keys)
    better = (least > np.minimum(before, behind)) | shorter
    rows = np.flatnonzero(better & (c != d) & ~taken)
    rows = rows[_apart(slivers[rows], other[rows], len(faces))]
    faces[slivers[rows]], faces[other[rows]] = new[rows, 0], new[rows, 1]
    return bool(len(rows))


def _apart(one: Indices, other: Indices, count: int) -> Bools:
    """Return which pairs of triangles share none with a pair before."""
    first = np.full(count, len(one))
    order = np.arange(len(one))
    np.minimum.at(first, one, order)
    np.minimum.at(first, other, order)
    return np.asarray((first[one] == order) & (first[other] == order))


def _heights(points: Floats, faces: Indices) -> tuple[Floats, Indices]:
    """Return the height of each triangle over its longest edge [m], and that edge's number."""
    corners = points[faces]
    ways = np.roll(corners, -1, axis=1) - corners
    lengths = np.linalg.norm(ways, axis=2)
    longest = lengths.argmax(axis=1)
    doubled = np.linalg.norm(np.cross(ways[:, 0], ways[:, 1]), axis=1)
    most = np.maximum(np.maximum(lengths[:, 0], lengths[:, 1]), lengths[:, 2])
    return doubled / np.maximum(most, 1e-300), longest


def _among(keys: Indices, others: Indices) -> Bools:
    """Return which of a few numbers are among many others."""
    ordered = np.unique(keys)
    place = np.minimum(np.searchsorted(ordered, others), len(ordered) - 1)
    found = np.zeros(len(ordered), bool)
    found[place[ordered[place] == others]] = True
    return np.asarray(found[np.searchsorted(ordered, keys)])
