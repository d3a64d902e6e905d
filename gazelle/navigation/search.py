"""The cheapest path over a grid: A*."""

from __future__ import annotations

import heapq
import math

import numpy as np

from gazelle.array_types import Floats

Cell = tuple[int, int]

_DIAGONAL = math.sqrt(2.0)


def find_path(costs: Floats, start: Cell, goal: Cell) -> list[Cell] | None:
    """Return the cheapest path from cell to cell, to all eight neighbours; None if there is none.

    Method: Hart, Nilsson and Raphael, "A formal basis for the heuristic determination of
    minimum cost paths", 1968; the heuristic is the octile distance.

    Args:
        costs: Of entering a cell, a length away: at least 1, and inf for what is closed;
            shape (columns, rows).
        start: Start of the path; it may be closed.
        goal: Its end.

    Returns:
        Cells from ``start`` to ``goal``.
    """
    # A closed rim spares the test whether a neighbour is on the grid.
    rim = np.pad(costs, 1, constant_values=math.inf)
    stride = rim.shape[1]
    cost: list[float] = rim.ravel().tolist()
    first = (start[0] + 1) * stride + start[1] + 1
    last = (goal[0] + 1) * stride + goal[1] + 1
    if math.isinf(cost[last]):
        return None
    came = _expand(cost, stride, first, last)
    if last != first and last not in came:
        return None
    path = [last]
    while path[-1] != first:
        path.append(came[path[-1]])
    return [(cell // stride - 1, cell % stride - 1) for cell in reversed(path)]


def _expand(cost: list[float], stride: int, first: int, last: int) -> dict[int, int]:
    """Return the best predecessor of each cell, expanded until the last one is reached."""
    straight = (1, -1, stride, -stride)
    moves = [(each, 1.0) for each in straight]
    moves += [(each + side, _DIAGONAL) for each in straight[2:] for side in straight[:2]]
    goal_column, goal_row = divmod(last, stride)
    best = {first: 0.0}
    came: dict[int, int] = {}
    done: set[int] = set()
    queue = [(0.0, first)]
    while queue:
        cell = heapq.heappop(queue)[1]
        if cell == last:
            break
        if cell in done:
            continue
        done.add(cell)
        spent = best[cell]
        for move, length in moves:
            other = cell + move
            total = spent + length * cost[other]
            if total < best.get(other, math.inf):
                best[other], came[other] = total, cell
                across, along = abs(other // stride - goal_column), abs(other % stride - goal_row)
                ahead = max(across, along) + (_DIAGONAL - 1.0) * min(across, along)
                heapq.heappush(queue, (total + ahead, other))
    return came
