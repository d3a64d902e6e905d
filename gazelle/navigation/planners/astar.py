"""Potential of the cells between two places of a grid: A*."""

# mypy: disallow-untyped-decorators=False

import cython
import numpy as np
from cython.cimports.libc.math import fabs, sqrt

from gazelle.array_types import Floats32

_FAR = cython.declare(cython.float, 1e10)


def search(
    traversal_costs: Floats32,
    values: Floats32,
    columns: int,
    ends: tuple[int, int],
    neutral: float,
    quadratic: int,
) -> bool:
    """Find the potentials of cells, those nearest to the target first, until it has its own.

    Each cell gets its potential once, from the first neighbour that leads to it, as in ROS's
    ``global_planner``: a path may cost more than the cheapest one.
    Method: Hart, Nilsson and Raphael, "A formal basis for the heuristic determination of minimum cost
    paths", 1968; the heuristic is the Manhattan distance.

    Args:
        traversal_costs: Of each cell, row by row; inf where it is closed, as all outermost cells are.
        values: Potentials of the cells, 1e10 at first; changed.
        columns: Of the grid.
        ends: Indices of the source and the target.
        neutral: Price of a cell in the heuristic.
        quadratic: 1 to solve with both axes; else a potential is that of the neighbour plus the cost.

    Returns:
        Whether the target was reached.
    """
    size = len(traversal_costs)
    keys = np.empty(size + 1, np.float32)
    cells = np.empty(size + 1, np.int32)
    return bool(
        _run(traversal_costs, values, keys, cells, columns, ends[0], ends[1], neutral, quadratic)
    )


@cython.ccall
def _run(
    cost: cython.float[::1],
    value: cython.float[::1],
    keys: cython.float[::1],
    cells: cython.int[::1],
    columns: cython.int,
    first: cython.int,
    last: cython.int,
    neutral: cython.float,
    quadratic: cython.bint,
) -> cython.bint:
    size: cython.int = cython.cast(cython.int, cost.shape[0])
    goal_x: cython.int = last % columns
    goal_y: cython.int = last // columns
    count: cython.int = 1
    side: cython.int
    keys[0], cells[0], value[first] = 0.0, first, 0.0
    while count > 0:
        cell: cython.int = cells[0]
        if cell == last:
            return True
        count -= 1
        _sink(keys, cells, count, keys[count], cells[count])
        for side in range(4):
            move: cython.int = 1 if side < 2 else columns
            n: cython.int = cell - move if side % 2 else cell + move
            # The source may be on the outermost row, which has none on its other side.
            if n < 0 or n >= size or value[n] < _FAR or cost[n] >= _FAR:
                continue
            value[n] = _potential(value, n, columns, cost[n], value[cell], quadratic)
            ahead: cython.float = fabs(n % columns - goal_x) + fabs(n // columns - goal_y)
            _rise(keys, cells, count, value[n] + neutral * ahead, n)
            count += 1
    return False


@cython.cfunc
@cython.inline
@cython.exceptval(check=False)
def _potential(
    value: cython.float[::1],
    n: cython.int,
    columns: cython.int,
    own: cython.float,
    before: cython.float,
    quadratic: cython.bint,
) -> cython.float:
    """Return the potential of a cell by its neighbours, as `PotentialField` solves it."""
    if not quadratic:
        return before + own
    a: cython.float = min(value[n + 1], value[n - 1])
    b: cython.float = min(value[n - columns], value[n + columns])
    apart: cython.float = fabs(a - b)
    if apart >= own:
        return min(a, b) + own
    return 0.5 * (a + b + sqrt(2.0 * own * own - apart * apart))


@cython.cfunc
@cython.exceptval(check=False)
def _rise(
    keys: cython.float[::1],
    cells: cython.int[::1],
    at: cython.int,
    key: cython.float,
    cell: cython.int,
) -> cython.void:
    """Insert a cell into the heap whose end is free."""
    while at > 0 and keys[(at - 1) // 2] > key:
        above: cython.int = (at - 1) // 2
        keys[at], cells[at] = keys[above], cells[above]
        at = above
    keys[at], cells[at] = key, cell


@cython.cfunc
@cython.exceptval(check=False)
def _sink(
    keys: cython.float[::1],
    cells: cython.int[::1],
    count: cython.int,
    key: cython.float,
    cell: cython.int,
) -> cython.void:
    """Insert a cell into the heap whose top is free."""
    at: cython.int = 0
    while 2 * at + 1 < count:
        below: cython.int = 2 * at + 1
        if below + 1 < count and keys[below + 1] < keys[below]:
            below += 1
        if keys[below] >= key:
            break
        keys[at], cells[at] = keys[below], cells[below]
        at = below
    keys[at], cells[at] = key, cell
