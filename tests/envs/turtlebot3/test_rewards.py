"""The turning reward and the limits; ``test_published_node`` compares all of it with the node."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gazelle.envs.turtlebot3.observations import RobotViews
from gazelle.envs.turtlebot3.rewards import judge, turning_reward
from gazelle.envs.turtlebot3.rules import STAGES


def _turn(heading, action):
    return float(turning_reward(np.array([heading]), np.array([float(action)]))[0])


def test_the_turn_at_the_goal_pays_most():
    headings = np.array([-math.pi / 4, -math.pi / 8, 0.0, math.pi / 8, math.pi / 4])
    index = np.arange(5.0)
    table = [[_turn(h, i) for i in index] for h in headings]
    assert [int(np.argmax(row)) for row in table] == [4, 3, 2, 1, 0]
    assert [max(row) for row in table] == pytest.approx([1.0] * 5)
    assert _turn(math.pi, 2) == pytest.approx(-1.0)


@given(st.floats(-math.pi, math.pi), st.floats(0, 4))
def test_the_wave_is_bounded_and_continuous_between_the_actions(heading, index):
    here, beside = _turn(heading, index), _turn(heading, index + 1e-6)
    assert -1.0 <= here <= 1.0
    assert abs(here - beside) < 1e-5


def _judged(rates, nearest=1.0, distance=1.0, heading=0.3):
    """Return what ``judge`` says of robots whose goals were as far when they were set."""
    n = len(rates)
    found = np.array([np.broadcast_to(e, n) for e in (nearest, nearest, distance, heading)])
    nothing = np.zeros((n, 0))
    seen = RobotViews(nothing, found, found[2], found[3], nothing, nothing)
    return judge(STAGES[1], seen, np.array(rates), found[2].copy())


def test_rates_between_the_discrete_actions_pay_what_the_wave_says():
    index = np.array([0.0, 0.5, 1.0, 2.0, 2.75, 3.0, 4.0])
    pays, _, _ = _judged(1.5 - 0.75 * index)
    wave = turning_reward(np.full(len(index), 0.3), index)
    assert pays == pytest.approx(2.0 * np.round(5.0 * wave, 2))


def test_limits_are_open_as_published():
    assert _judged([0.0] * 3, nearest=[0.0, 0.129, 0.13])[1].tolist() == [False, True, False]
    assert _judged([0.0] * 2, distance=[0.19, 0.2])[2].tolist() == [True, False]


def test_the_goal_pays_also_in_a_collision():
    pays, _, _ = _judged([0.0] * 2, nearest=0.1, distance=[0.1, 1.0])
    assert pays.tolist() == [200.0, -200.0]
