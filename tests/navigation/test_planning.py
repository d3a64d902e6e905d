"""Ways over a map keep the base's clearance where they can, and its room always."""

from __future__ import annotations

import numpy as np
import pytest

from gazelle.navigation import OccupancyGrid
from gazelle.navigation.limits import BaseLimits
from gazelle.navigation.planning import plan

LIMITS = BaseLimits(radius=0.2, clearance=0.05)
START, GOAL = np.array([1.0, 1.0]), np.array([3.0, 1.0])


def walled(gap):
    """Return a wall between start and goal with a gap of so many cells of 5 cm around y = 1."""
    grid = OccupancyGrid(0.05)
    grid.include([[0.0, 0.0], [4.0, 2.0]])
    column = grid.cell_of((2.0, 1.0))[0]
    first = grid.cell_of((2.0, 1.0))[1] - gap // 2
    grid.cells[column, :] = 2.0
    grid.cells[column, first : first + gap] = -1.0
    return grid


def nearest_obstacle(grid, way):
    walls = grid.centre_of(np.argwhere(grid.occupied))
    return np.hypot(*(way[:, None] - walls).transpose(2, 0, 1)).min()


@pytest.mark.parametrize(("gap", "room"), [(13, 0.25), (9, 0.2)])
def test_a_gap_is_gone_through_with_clearance_or_else_without(gap, room):
    grid = walled(gap)
    way = plan(grid, START, GOAL, LIMITS)
    assert way[-1] == pytest.approx(GOAL)
    assert nearest_obstacle(grid, way) >= room


def test_what_is_narrower_than_the_base_is_no_way():
    assert plan(walled(7), START, GOAL, LIMITS).shape == (0, 2)
