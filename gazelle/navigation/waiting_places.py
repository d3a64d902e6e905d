"""Waiting places on a map, where a robot does not obstruct another one."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from gazelle.array_types import Bools, Floats, Floats32
from gazelle.description.occupancy import OccupancyMap
from gazelle.navigation.costmap.distances import squared_distances
from gazelle.navigation.planners.potential import NOT_REACHED, PotentialField

_NEUTRAL: Final = 50.0
_NEAR_WALLS: Final = 200.0
_DECAY: Final = 4.0
"""Traversal cost of a cell: 50, and up to 200 more at a wall, falling by e every 0.25 m."""
_MARGIN: Final = 0.1
"""Between robots that pass each other [m]."""
_CLOSE: Final = 0.15
"""Distance of the map's obstacles from those that a robot may see [m]."""
_OCCUPIED: Final = 50


@dataclass(frozen=True, slots=True)
class RobotDisc:
    """A robot from above.

    Attributes:
        x: Its middle [m].
        y: Likewise.
        inscribed: Radius of the largest circle within it [m].
        circumscribed: Radius of the smallest circle around it [m].
    """

    x: float
    y: float
    inscribed: float
    circumscribed: float

    def apart(self, other: RobotDisc) -> float:
        """Return the distance at which the two pass each other in any case [m]."""
        return self.circumscribed + other.circumscribed + _MARGIN


class WaitingPlaceMap:
    """Paths and places on a map, by static obstacles only.

    Args:
        grid: The map; what is unknown is closed.
    """

    def __init__(self, grid: OccupancyMap) -> None:
        closed = (grid.data < 0) | (grid.data >= _OCCUPIED)
        self._side = grid.resolution
        self._corner = np.array([grid.origin.x, grid.origin.y])
        # From the middle of a cell to the border of the nearest closed one.
        squares = squared_distances(closed.view(np.uint8))
        self._room: Floats = (np.sqrt(squares) - 0.5) * self._side
        rows, columns = closed.shape
        self._field = PotentialField(rows, columns)
        self._x = self._corner[0] + (np.arange(columns) + 0.5) * self._side
        self._y = self._corner[1] + (np.arange(rows) + 0.5) * self._side

    def has(self, places: Floats) -> Bools:
        """Return whether the map has an obstacle at or close to positions, shape (n,).

        Args:
            places: x and y [m], shape (n, 2).
        """
        cells = np.floor((places - self._corner) / self._side).astype(int)
        cells = np.clip(cells, 0, np.array(self._room.shape[::-1]) - 1)
        found: Bools = self._room[cells[:, 1], cells[:, 0]] < _CLOSE
        return found

    def path(self, robot: RobotDisc, goal: Sequence[float]) -> Floats:
        """Return the path to a place without other robots, shape (n, 2) [m]; empty without one."""
        start, end = self._cell(robot.x, robot.y), self._cell(goal[0], goal[1])
        if start is None or end is None:
            return np.zeros((0, 2))
        traversal_costs = self._traversal_costs(robot)
        if not self._field.spread(traversal_costs, start, end, _NEUTRAL):
            return np.zeros((0, 2))
        cells = self._field.way_down(end, start, False)[::-1]
        found: Floats = self._corner + (cells + 0.5) * self._side
        return found

    def waiting_place(
        self,
        robot: RobotDisc,
        leader: RobotDisc,
        path: Floats,
        bodies: Sequence[RobotDisc],
        taken: Sequence[RobotDisc],
    ) -> RobotDisc | None:
        """Return the place with the shortest path where a robot obstructs no other.

        Args:
            robot: Robot that yields.
            leader: Robot that has priority.
            path: Of the leader, shape (n, 2) [m].
            bodies: Robots that stay where they are.
            taken: Places that others will stand at.

        Returns:
            The robot there; None if there is no such place.
        """
        start = self._cell(robot.x, robot.y)
        if start is None:
            return None
        traversal_costs = self._traversal_costs(robot)
        for body in (leader, *bodies):
            # One that almost touches another can still go away from it.
            apart = math.dist((body.x, body.y), (robot.x, robot.y)) - 1.5 * self._side
            traversal_costs[
                self._within(body, min(body.circumscribed + robot.inscribed, apart))
            ] = 0.0
        self._field.spread(traversal_costs, start, None, _NEUTRAL)
        costs = self._field.values
        good = (costs < NOT_REACHED) & (self._room >= robot.circumscribed)
        good &= self._away_from(path) >= robot.apart(leader)
        for other in (leader, *bodies, *taken):
            good &= ~self._within(other, robot.apart(other))
        if not good.any():
            return None
        row, column = np.unravel_index(int(np.where(good, costs, np.inf).argmin()), costs.shape)
        x, y = float(self._x[column]), float(self._y[row])
        return RobotDisc(x, y, robot.inscribed, robot.circumscribed)

    def _traversal_costs(self, robot: RobotDisc) -> Floats32:
        """Return the cost of a cell's length for a robot, 0 where it is closed.

        Shape (rows, columns).
        """
        spare = self._room - robot.inscribed
        traversal_costs = _NEUTRAL + _NEAR_WALLS * np.exp(-_DECAY * np.maximum(spare, 0.0))
        traversal_costs[spare < 0.0] = 0.0
        # Where it stands it can move, although a map of whole cells has walls beside it.
        about = self._within(robot, robot.circumscribed) & (self._room > 0.0)
        traversal_costs[about & (spare < 0.0)] = _NEUTRAL + _NEAR_WALLS
        return traversal_costs.astype(np.float32)

    def _away_from(self, path: Floats) -> Floats:
        """Return the distance of each cell from a path [m], shape (rows, columns)."""
        marked = np.zeros(self._room.shape, np.uint8)
        cells = np.floor((path - self._corner) / self._side).astype(int)
        # The path may be on another robot's map.
        cells = cells[((cells >= 0) & (cells < marked.shape[::-1])).all(axis=1)]
        marked[cells[:, 1], cells[:, 0]] = 1
        away: Floats = np.sqrt(squared_distances(marked)) * self._side
        return away

    def _within(self, robot: RobotDisc, radius: float) -> Bools:
        """Return a mask of cells within a distance of a robot's centre, shape (rows, columns)."""
        squares = (self._y[:, None] - robot.y) ** 2 + (self._x[None, :] - robot.x) ** 2
        within: Bools = squares < max(radius, 0.0) ** 2
        return within

    def _cell(self, x: float, y: float) -> tuple[int, int] | None:
        """Return column and row of a place; None at the closed rim, and beyond."""
        column = math.floor((x - self._corner[0]) / self._side)
        row = math.floor((y - self._corner[1]) / self._side)
        rows, columns = self._room.shape
        return (column, row) if 0 < column < columns - 1 and 0 < row < rows - 1 else None
