"""Pieces of a surface taken together by the cells of a grid, where there are too many to merge."""

from __future__ import annotations

import numpy as np

from gazelle.array_types import Floats, Indices


def grouped_by_cells(
    clouds: list[Floats], pairs: Indices, side: float
) -> tuple[list[Floats], Indices]:
    """Return the points of pieces, those of small ones in the same cell as one, and which touch.

    Args:
        clouds: Points of each piece [m], shapes (n, 3).
        pairs: Rows of two pieces that touch, shape (k, 2).
        side: Side of a cell [m]; pieces that are larger stay alone.
    """
    points = np.concatenate(clouds)
    sizes = np.array([len(cloud) for cloud in clouds])
    starts = np.cumsum(sizes) - sizes
    low, high = (f.reduceat(points, starts) for f in (np.minimum, np.maximum))
    cells = np.floor((low + high) / (2.0 * side))
    alone = np.linalg.norm(high - low, axis=1) > side
    keys = np.column_stack([cells, np.where(alone, np.arange(len(clouds)), -1)])
    label = np.unique(keys, axis=0, return_inverse=True)[1].ravel()
    order = np.argsort(label, kind="stable")
    ends = np.flatnonzero(np.diff(label[order], append=-1))[:-1] + 1
    members = np.split(order, ends)
    grouped = [np.concatenate([clouds[row] for row in rows.tolist()]) for rows in members]
    ends_of_pairs = np.sort(label[pairs], axis=1)
    apart = ends_of_pairs[:, 0] != ends_of_pairs[:, 1]
    return grouped, np.unique(ends_of_pairs[apart], axis=0)
