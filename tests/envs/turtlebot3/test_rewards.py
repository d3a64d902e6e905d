"""The turning reward and the limits; ``test_published_node`` compares all of it with the node."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gazelle.envs.turtlebot3.actions import turn_index
from gazelle.envs.turtlebot3.rewards import turning_reward
from gazelle.envs.turtlebot3.rules import STAGES
from gazelle.envs.turtlebot3.terminations import collided, reached


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


def test_continuous_yaw_rates_meet_the_discrete_actions():
    rates = np.array([1.5, 0.75, 0.0, -0.75, -1.5])
    assert turn_index(rates).tolist() == [0.0, 1.0, 2.0, 3.0, 4.0]


def test_limits_are_open_as_published():
    rules = STAGES[1]
    assert collided(rules, np.array([0.0, 0.129, 0.13])).tolist() == [False, True, False]
    assert reached(rules, np.array([0.19, 0.2])).tolist() == [True, False]
