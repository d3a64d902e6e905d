"""Bumpers of Stage's robots."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from stage_samples import draw

from gazelle import SimulationError
from gazelle.stage.bumpers import gaps_to

BUMPER = (
    "bumper ( bcount 4 blength 0.4 noblocks 1 "
    "bpose[0] [0.2 0 0 0] bpose[1] [0 0.2 0 90] bpose[2] [-0.2 0 0 180] bpose[3] [0 -0.2 0 -90] )"
)
ROBOT = f'position ( name "r" size [.4 .4 .4] {BUMPER} )\n'


def test_nothing_is_touched_in_the_open(start):
    assert start(ROBOT).bumps("r") == (None, None, None, None)


@pytest.mark.parametrize(("where", "strip"), [((1, 0), 0), ((0, 1), 1), ((-1, 0), 2), ((0, -1), 3)])
def test_the_strip_on_its_side_touches_a_wall(start, where, strip):
    x, y = 0.515 * where[0] + 0.0, 0.515 * where[1] + 0.0
    wall = f'model ( name "w" size [.6 .6 1] pose [{x} {y} 0 0] )'
    touched = start(ROBOT + wall).bumps("r")
    assert touched[strip] == "w"
    assert touched[(strip + 2) % 4] is None


def test_a_wall_a_cell_away_is_not_touched(start):
    wall = 'model ( name "w" size [.6 .6 1] pose [{} 0 0 0] )'
    assert start("resolution 0.02\n" + ROBOT + wall.format(0.519)).bumps("r")[0] == "w"
    assert start("resolution 0.02\n" + ROBOT + wall.format(0.521)).bumps("r")[0] is None


def test_bitmaps_other_robots_and_what_is_no_obstacle_are_touched(start, tmp_path):
    draw(tmp_path, ["#"])
    for other in (
        'model ( name "o" size [1 1 1] pose [.71 0 0 0] bitmap "map.png" )',
        'position ( name "o" size [1 1 1] pose [.71 0 0 0] )',
        'model ( name "o" size [1 1 1] pose [.71 0 0 0] obstacle_return 0 )',
    ):
        assert start(ROBOT + other).bumps("r")[0] == "o"


def test_what_is_above_or_below_the_robot_is_not_touched(start):
    above = 'model ( name "o" size [1 1 1] pose [.71 0 .5 0] )'
    assert start(ROBOT + above).bumps("r")[0] is None


def test_bumpers_go_with_their_robot_in_each_world(start):
    sim = start(ROBOT + 'model ( name "w" size [1 1 1] pose [5 0 0 0] )', nworld=2)
    sim.set_pose("r", (4.29, 0.0, math.pi), np.array([1]))
    assert sim.bumps("r") == (None,) * 4
    assert sim.bumps("r", world=1)[2] == "w"
    assert sim.bumps("r", world=1)[0] is None


def test_a_robot_without_bumper_is_told_so(start):
    with pytest.raises(SimulationError, match="0 StageBumper"):
        start('position ( name "r" )').bumps("r")


points = st.tuples(*[st.floats(-3, 3, width=32)] * 2)


@given(points, points, points, points)
def test_gaps_are_the_least_distance_of_points_along_both(a, b, c, d):
    share = np.linspace(0, 1, 60)[:, None]
    one = np.array(a) + share * (np.array(b) - a)
    other = np.array(c) + share * (np.array(d) - c)
    sampled = np.linalg.norm(one[:, None] - other[None], axis=2).min()
    gap = gaps_to(np.array([a, b]), np.array([[*c, *d]]))[0]
    assert gap <= sampled + 1e-9
    assert gap >= sampled - 0.15
