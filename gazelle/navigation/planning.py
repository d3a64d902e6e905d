"""Plan a path over a map with room for the base."""

from __future__ import annotations

import numpy as np

from gazelle.array_types import Bools, Floats
from gazelle.navigation.grid import OccupancyGrid
from gazelle.navigation.limits import BaseLimits
from gazelle.navigation.search import Cell, find_path

# Prices of a cell: near an obstacle a path of twice or four times the length is preferred.
_NEAR = ((0.1, 4.0), (0.25, 2.0))
_TIGHT = 20.0  # of ground that is too near to an obstacle, but where the base stands already
_GOAL_WITHIN = 0.4  # beyond its room; else a goal in an obstacle has no path [m]


def plan(grid: OccupancyGrid, start: Floats, goal: Floats, limits: BaseLimits) -> Floats:
    """Return a path from place to place, as far from obstacles as is worth it.

    Args:
        grid: Known map; it grows to hold both places. Unknown ground counts as free.
        start: (x, y) [m].
        goal: (x, y) [m]; if an obstacle is too near, the free place nearest to it is taken.
        limits: Of the base.

    Returns:
        Points from start to goal [m], shape (n, 2), a cell apart; (0, 2) if there is no path, not
        even one without clearance.
    """
    grid.include(np.stack((start, goal)))
    cells = _cheapest_cells(grid, start, goal, limits, limits.radius + limits.clearance)
    if cells is None:
        # A map draws walls thicker than they are: where a base got in it may get out.
        cells = _cheapest_cells(grid, start, goal, limits, limits.radius)
    if cells is None:
        return np.zeros((0, 2))
    points = grid.centre_of(cells)
    if cells[-1] == _cell(grid, goal):
        points[-1] = goal
    return _smoothed(points)


def _cheapest_cells(
    grid: OccupancyGrid, start: Floats, goal: Floats, limits: BaseLimits, room: float
) -> list[Cell] | None:
    """Return the cells of the cheapest path with a clearance [m]; None without one."""
    costs = _cell_costs(grid, start, room)
    last = _nearest_open(grid, costs, start, goal, limits)
    return None if last is None else find_path(costs, _cell(grid, start), last)


def is_blocked(grid: OccupancyGrid, path: Floats, here: Floats, limits: BaseLimits) -> bool:
    """Return whether an obstacle has turned up on the rest of a path."""
    rest = path[int(np.hypot(*(path - here).T).argmin()) :]
    rest = rest[np.hypot(*(rest - here).T) > limits.radius]
    return bool(grid.is_near(rest, limits.radius + 0.5 * limits.clearance).any())


def _cell_costs(grid: OccupancyGrid, start: Floats, room: float) -> Floats:
    costs = np.ones(grid.cells.shape)
    for distance, cost in reversed(_NEAR):
        costs[grid.near_obstacles(room + distance)] = cost
    costs[grid.near_obstacles(room)] = np.inf
    here = _around(grid, start, room)
    costs[here & np.isinf(costs) & ~grid.occupied] = _TIGHT
    return costs


def _around(grid: OccupancyGrid, place: Floats, distance: float) -> Bools:
    """Return cells within a distance of a place."""
    columns, rows = grid.cells.shape
    x = grid.origin[0] + (np.arange(columns) + 0.5) * grid.resolution - place[0]
    y = grid.origin[1] + (np.arange(rows) + 0.5) * grid.resolution - place[1]
    near: Bools = np.hypot(x[:, None], y) <= distance
    return near


def _cell(grid: OccupancyGrid, place: Floats) -> Cell:
    column, row = grid.cell_of(place).tolist()
    return column, row


def _nearest_open(
    grid: OccupancyGrid, costs: Floats, start: Floats, goal: Floats, limits: BaseLimits
) -> Cell | None:
    """Return the cell of the goal, or an open one near to it."""
    wished = _cell(grid, goal)
    open_to = costs < _TIGHT
    if open_to[wished]:
        return wished
    within = limits.radius + limits.clearance + _GOAL_WITHIN
    near = np.argwhere(open_to & _around(grid, goal, within))
    if not len(near):
        return None
    # Of places as near to the goal the one on this side is taken, lest it circles the goal.
    places = grid.centre_of(near)
    distance = 3.0 * np.hypot(*(places - goal).T) + np.hypot(*(places - start).T)
    column, row = near[int(distance.argmin())].tolist()
    return column, row


def _smoothed(points: Floats) -> Floats:
    """Return the corners of the grid rounded: each point in the middle of its five neighbours."""
    if len(points) < 5:
        return points
    padded = np.concatenate((points[:1], points[:1], points, points[-1:], points[-1:]))
    count = len(points)
    smooth: Floats = sum((padded[i : i + count] for i in range(5)), np.zeros((count, 2))) / 5.0
    smooth[0], smooth[-1] = points[0], points[-1]
    return smooth
