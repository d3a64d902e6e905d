"""Distances over a small grid around what is in the way, in whole cells."""

# mypy: disallow-untyped-decorators=False

import cython
import numpy as np

from gazelle.array_types import Bytes, Indices, Ints32


def grid_distances(costs: Bytes, sources: Indices) -> Ints32:
    """Compute steps along x and y from each cell to the nearest source.

    Args:
        costs: Of a costmap; from 253 on a cell is closed, shape (rows, columns).
        sources: Columns and rows of cells where the distance is 0, on the grid, shape (n, 2).

    Returns:
        Shape (rows, columns); rows * columns in closed cells next to others that are reached, one
        more in cells that are not reached.
    """
    rows, columns = costs.shape
    result = np.full((rows, columns), rows * columns + 1, np.int32)
    queue = np.empty(rows * columns, np.int32)
    _spread(np.ascontiguousarray(costs), sources, result, queue)
    return result


@cython.ccall
def _spread(
    costs: cython.uchar[:, ::1],
    sources: cython.Py_ssize_t[:, ::1],
    result: cython.int[:, ::1],
    queue: cython.int[::1],
) -> cython.void:
    rows: cython.int = costs.shape[0]
    columns: cython.int = costs.shape[1]
    obstacle: cython.int = rows * columns
    first: cython.int = 0
    last: cython.int = 0
    i: cython.Py_ssize_t
    side: cython.int
    x: cython.int
    y: cython.int
    count: cython.Py_ssize_t = sources.shape[0]
    for i in range(count):
        x, y = sources[i, 0], sources[i, 1]
        if result[y, x] != 0:
            result[y, x] = 0
            queue[last] = y * columns + x
            last += 1
    while first < last:
        x, y = queue[first] % columns, queue[first] // columns
        first += 1
        distance: cython.int = result[y, x] + 1
        for side in range(4):
            other_x: cython.int = x + (1 if side == 0 else -1 if side == 1 else 0)
            other_y: cython.int = y + (1 if side == 2 else -1 if side == 3 else 0)
            if other_x < 0 or other_y < 0 or other_x >= columns or other_y >= rows:
                continue
            if result[other_y, other_x] <= obstacle:
                continue
            if costs[other_y, other_x] >= 253:
                result[other_y, other_x] = obstacle
            else:
                result[other_y, other_x] = distance
                queue[last] = other_y * columns + other_x
                last += 1
