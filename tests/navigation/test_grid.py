"""The map holds what rays hit, frees what they pass, and grows."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gazelle.errors import SimulationError
from gazelle.navigation import OccupancyGrid
from gazelle.navigation.grid import dilate


def seen(grid, point):
    return grid.cells[tuple(grid.cell_of(point))]


def test_a_ray_frees_its_way_and_marks_its_end():
    grid = OccupancyGrid(0.1)
    for _ in range(2):
        grid.insert((0.0, 0.0), np.array([[2.05, 0.05], [0.05, 3.05]]), np.array([True, False]))
    assert seen(grid, (2.05, 0.05)) > 0.0
    assert seen(grid, (1.0, 0.05)) < 0.0
    assert seen(grid, (0.05, 2.9)) < 0.0
    assert seen(grid, (0.05, 3.05)) <= 0.0
    assert seen(grid, (1.0, 1.0)) == 0.0
    assert grid.occupied.sum() == 1


def test_what_went_away_is_forgotten():
    grid = OccupancyGrid(0.1)
    end = np.array([[2.05, 0.0]])
    for _ in range(5):
        grid.insert((0.0, 0.0), end, np.array([True]))
    assert grid.occupied.any()
    for _ in range(10):
        grid.insert((0.0, 0.0), 2 * end, np.array([True]))
    assert not grid.occupied[tuple(grid.cell_of(end[0]))]
    assert grid.occupied[tuple(grid.cell_of(2 * end[0]))]


def test_growing_moves_nothing():
    grid = OccupancyGrid(0.05)
    grid.insert((0.0, 0.0), np.array([[1.0, 0.5]]), np.array([True]))
    before = grid.centre_of(np.argwhere(grid.occupied))
    grid.include([(-7.3, 4.1), (3.0, -9.9)])
    np.testing.assert_allclose(grid.centre_of(np.argwhere(grid.occupied)), before, atol=1e-9)
    for point in ((-7.3, 4.1), (3.0, -9.9)):
        assert (grid.cell_of(point) >= 0).all()
        assert (grid.cell_of(point) < grid.cells.shape).all()


@pytest.mark.long
@given(st.lists(st.tuples(st.integers(0, 19), st.integers(0, 24)), max_size=6), st.floats(0.0, 7.0))
def test_a_grown_mask_is_what_is_within_the_radius(marked, radius):
    mask = np.zeros((20, 25), np.bool_)
    for cell in marked:
        mask[cell] = True
    grown = dilate(mask, radius)
    for cell in np.ndindex(mask.shape):
        near = any(np.hypot(cell[0] - c, cell[1] - r) <= radius for c, r in marked)
        assert grown[cell] == near


@given(st.integers(0, 1000), st.floats(0.0, 0.6))
def test_being_near_is_the_same_for_points_and_for_the_map(seed, distance):
    stream = np.random.default_rng(seed)
    grid = OccupancyGrid(0.1)
    grid.include([(-2.0, -1.0), (2.0, 1.5)])
    grid.cells[tuple((stream.uniform(size=(5, 2)) * grid.cells.shape).astype(int).T)] = 2.0
    points = stream.uniform((-2.0, -1.0), (2.0, 1.5), (40, 2))
    near = grid.near_obstacles(distance)[tuple(grid.cell_of(points).T)]
    np.testing.assert_array_equal(grid.is_near(points, distance), near)


def test_a_cell_has_a_size():
    with pytest.raises(SimulationError, match="resolution"):
        OccupancyGrid(0.0)
