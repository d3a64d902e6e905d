"""The goals are those of the published node."""

import numpy as np
import pytest

from gazelle.envs.turtlebot3.places import grid_goals, plaza_goals

CENTRES = [(0.6, 0.6), (0.6, -0.6), (-0.6, 0.6), (-0.6, -0.6), (0.0, 0.0)]


def accepted(x, y, last=None):
    """Return whether the published rejection loop would take a goal."""
    for a, b in CENTRES:
        if abs(x - a) <= 0.4 and abs(y - b) <= 0.4:
            return False
    return last is None or not (abs(x - last[0]) < 1 and abs(y - last[1]) < 1)


def test_the_grid_holds_what_the_loop_accepts():
    expected = {
        (i / 10, j / 10) for i in range(-12, 13) for j in range(-12, 13) if accepted(i / 10, j / 10)
    }
    assert set(map(tuple, grid_goals().points.tolist())) == expected


@pytest.mark.parametrize("table", [grid_goals(), plaza_goals()])
def test_the_first_goal_is_ahead(table):
    assert table.points[table.start].tolist() == [0.6, 0.0]


@pytest.mark.parametrize("last", [0, 57, 150])
def test_followers_are_those_the_loop_accepts(last):
    table = grid_goals()
    points = table.points.tolist()
    expected = [i for i, (x, y) in enumerate(points) if accepted(x, y, points[last])]
    uniform = (np.arange(20_000) + 0.5) / 20_000
    after = table.after(np.full(20_000, last), uniform)
    counts = np.bincount(after, minlength=len(points))
    assert np.flatnonzero(counts).tolist() == expected
    assert counts[expected].max() - counts[expected].min() <= 1


def test_thirteen_places_in_the_plaza():
    assert plaza_goals().points.shape == (13, 2)
