"""The state's layout."""

import math

import numpy as np
import pytest

from gazelle.envs.turtlebot3.observations import observation_space, sight
from gazelle.envs.turtlebot3.rules import STAGES


def state(stage, ranges):
    return sight(
        STAGES[stage],
        ranges=np.array([ranges]),
        range_min=0.12,
        pose=np.array([[0.1, 0.2, 0.5]]),
        goal=np.array([[1.0, 1.0]]),
    ).state


def test_ranges_heading_distance_obstacle():
    heading = round(math.atan2(0.8, 0.9) - 0.5, 2)
    distance = round(math.hypot(0.8, 0.9), 2)
    expected = [1.234, 3.5, 0.567, 0.12, heading, distance, 0.12, 3]
    got = state(2, [1.234, math.inf, 0.567, -math.inf])
    assert got.dtype == np.float32
    assert got.tolist() == [np.array(expected, dtype=np.float32).tolist()]


def test_stage_1_has_no_obstacle_part():
    assert state(1, [1.0, 2.0]).shape == (1, 4)
    assert state(2, [1.0, 2.0]).shape == (1, 6)


@pytest.mark.parametrize(("stage", "size"), [(1, 26), (2, 28), (3, 28), (4, 28)])
def test_the_space_has_the_published_size(stage, size):
    space = observation_space(STAGES[stage], 24, distance_max=6.0)
    assert space.shape == (size,)
    assert np.isfinite(space.high).all()
