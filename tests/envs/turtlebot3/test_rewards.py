"""Rewards and ends against a scalar reading of the published formula."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gazelle.envs.turtlebot3.actions import turn_index
from gazelle.envs.turtlebot3.rewards import overrule, travelling_reward, turning_reward
from gazelle.envs.turtlebot3.rules import STAGES
from gazelle.envs.turtlebot3.terminations import collided, reached

cents = st.integers(1, 700).map(lambda n: round(n / 100, 2))
headings = st.integers(-314, 314).map(lambda n: round(n / 100, 2))
stages = st.sampled_from([1, 2, 3, 4])


def published(stage, heading, action, distance, start, nearest, crashed, arrived):
    """One number at a time, with Python's own arithmetic."""
    phi = math.pi / 2 - math.pi / 4 + heading + action * math.pi / 8
    part, _ = math.modf(0.25 + ((0.5 * phi) % (2 * math.pi)) / math.pi)
    r = 1 - 4 * abs(0.5 - part)
    reward = round(5 * r, 2) * 2 ** (distance / start)
    if stage == 4 and nearest < 0.5:
        reward -= 5
    if crashed:
        reward = {1: -200, 2: -150, 3: -150, 4: -500}[stage]
    if arrived:
        reward = 1000 if stage == 4 else 200
    return reward


@given(stages, headings, st.integers(0, 4), cents, cents, cents, st.booleans(), st.booleans())
def test_is_the_published_reward(stage, heading, action, distance, start, nearest, hit, there):
    rules = STAGES[stage]
    reward = travelling_reward(
        rules,
        heading=np.array([heading]),
        index=np.array([float(action)]),
        distance=np.array([distance]),
        start_distance=np.array([start]),
        nearest=np.array([nearest]),
    )
    reward = overrule(rules, reward, collided=np.array([hit]), reached=np.array([there]))
    expected = published(stage, heading, action, distance, start, nearest, hit, there)
    # The rounding to 0.01 may fall to the other side where pi/8 * i is summed in another order.
    step = 0.0100001 * 2 ** (distance / start)
    assert reward[0] == pytest.approx(expected, rel=1e-12, abs=step)
    same = math.isclose(reward[0], expected, rel_tol=1e-12)
    close_to_tie = abs(abs(round(500 * _turn(heading, action) % 1, 9)) - 0.5) < 1e-6
    assert same or close_to_tie


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
