"""An estimate must not depend on how many episodes are asked for."""

from __future__ import annotations

from typing import ClassVar

import gymnasium as gym
import numpy as np
import pytest
from gymnasium.vector import AutoresetMode, VectorEnv
from hypothesis import given, settings
from hypothesis import strategies as st

from gazelle.training import Actor, evaluate

IDLE = Actor((np.zeros((1, 2), np.float32),), (np.zeros(2, np.float32),), "tanh", "categorical")
AT_FIRST = 0.6


class Halls(VectorEnv):
    """Robots in halls: those that fail do so at once, those that arrive take 9 steps.

    In a hall that is no longer new (``worn``) all that begin arrive. With ``mood`` all robots of a
    hall fare alike at first.
    """

    metadata: ClassVar = {"autoreset_mode": AutoresetMode.DISABLED}

    def __init__(self, num_envs=1, robots=1, worn=1.0, mood=False):
        self.num_envs, self.robots, self.worn, self.mood = num_envs, robots, worn, mood
        self.single_observation_space = gym.spaces.Box(0.0, 1.0, (1,), np.float32)
        self.single_action_space = gym.spaces.Discrete(2)
        batch = gym.vector.utils.batch_space
        self.observation_space = batch(self.single_observation_space, num_envs)
        self.action_space = batch(self.single_action_space, num_envs)

    @staticmethod
    def fitting_num_envs(num_envs, options):
        robots = options.get("robots", 1)
        return -(-num_envs // robots) * robots

    def reset(self, *, seed=None, options=None):
        mask = (options or {}).get("reset_mask")
        if mask is None:
            self.rng = np.random.default_rng(seed)
            self.good, self.left = np.zeros(self.num_envs, bool), np.zeros(self.num_envs, int)
        fresh = mask is None
        mask = np.ones(self.num_envs, bool) if fresh else mask
        drawn = self.rng.random(self.num_envs)
        if self.mood:
            drawn = np.repeat(drawn[:: self.robots], self.robots)
        good = drawn < (AT_FIRST if fresh else self.worn)
        self.good = np.where(mask, good, self.good)
        self.left = np.where(mask, np.where(good, 9, 1), self.left)
        return self.look(), {"scenario": self.rng.random((self.num_envs, 1))}

    def step(self, actions):
        self.left -= 1
        ended = self.left == 0
        info = {"is_success": ended & self.good, "is_collision": ended & ~self.good}
        return self.look(), np.zeros(self.num_envs), ended, np.zeros_like(ended), info

    def look(self):
        return np.full((self.num_envs, 1), 0.5, np.float32)


if "test/Halls-v0" not in gym.registry:
    gym.register("test/Halls-v0", vector_entry_point=Halls, entry_point=Halls)


def spread(found):
    """Return the estimate's error in standard deviations."""
    rate = found.success
    return abs(rate.value - AT_FIRST) / np.sqrt(AT_FIRST * (1 - AT_FIRST) / rate.total)


@settings(max_examples=40)
@given(
    robots=st.sampled_from([2, 5, 30]),
    episodes=st.integers(1, 200),
    num_envs=st.integers(1, 64),
    seed=st.integers(0, 1000),
)
def test_a_world_that_wears_is_judged_alike_for_any_number_of_episodes(
    robots, episodes, num_envs, seed
):
    found = evaluate(
        IDLE, task="test/Halls-v0", episodes=episodes, num_envs=num_envs, seed=seed, robots=robots
    )
    assert found.episodes == found.distinct == -(-episodes // robots) * robots
    assert spread(found) < 4.5
    low, high = found.success.interval
    assert low - 0.2 < AT_FIRST < high + 0.2


@settings(max_examples=40)
@given(episodes=st.integers(1, 200), num_envs=st.integers(1, 64), seed=st.integers(0, 1000))
def test_worlds_of_one_are_judged_alike_for_any_number_of_episodes(episodes, num_envs, seed):
    """Failures end at once, so a count of what ends first would see too many of them."""
    found = evaluate(
        IDLE,
        task="test/Halls-v0",
        episodes=episodes,
        num_envs=num_envs,
        seed=seed,
        worn=AT_FIRST,
    )
    assert found.episodes == episodes
    assert spread(found) < 4.5


def test_estimates_are_right_on_average_and_intervals_hold_them():
    for robots, episodes in ((5, 5), (5, 50), (30, 300)):
        found = [
            evaluate(IDLE, task="test/Halls-v0", episodes=episodes, seed=seed, robots=robots)
            for seed in range(40)
        ]
        values = [each.success.value for each in found]
        assert np.mean(values) == pytest.approx(AT_FIRST, abs=4 * np.std(values) / np.sqrt(40))
        inside = [each.success.interval[0] < AT_FIRST < each.success.interval[1] for each in found]
        assert np.mean(inside) > 0.88


def test_robots_of_one_world_that_fare_alike_tell_as_much_as_one():
    given = {"task": "test/Halls-v0", "episodes": 600, "robots": 30, "mood": True}
    inside, widths = [], []
    for seed in range(40):
        low, high = evaluate(IDLE, seed=seed, **given).success.interval
        inside.append(low < AT_FIRST < high)
        widths.append(high - low)
    assert np.mean(inside) > 0.9
    assert 0.3 < np.mean(widths) < 0.5  # of 20 halls


@pytest.mark.long
def test_workers_find_the_same_in_worlds_that_robots_share():
    given = {"task": "AGVFleet", "agents": 4, "episodes": 24, "num_envs": 16}
    weight = np.zeros((28, 2), np.float32)
    weight[25, 1] = 1.5
    turning = Actor((weight,), (np.array([0.6, 0.0], np.float32),), "tanh", "gaussian",
                    low=np.full(2, -1.0, np.float32), high=np.full(2, 1.0, np.float32))  # fmt: skip
    one, two = (
        evaluate(turning, workers=workers, max_episode_steps=60, **given) for workers in (1, 2)
    )
    assert one.records == two.records
    assert one.episodes == 24


class Courier(gym.Env):
    """Goals one after the other: four of ten attempts fail, after 2 steps, the others take 40."""

    observation_space = gym.spaces.Box(0.0, 1.0, (1,), np.float32)
    action_space = gym.spaces.Discrete(2)

    def reset(self, *, seed=None, options=None):
        super().reset(seed=seed)
        self.attempt()
        return np.full(1, 0.5, np.float32), {"scenario": self.np_random.random(1)}

    def attempt(self):
        self.good = bool(self.np_random.random() < AT_FIRST)
        self.left = 40 if self.good else 2

    def step(self, action):
        self.left -= 1
        good, over = self.good, self.left == 0
        info = {"is_success": over and good, "is_collision": over and not good}
        if over and good:
            self.attempt()
        return np.full(1, 0.5, np.float32), 0.0, over and not good, False, info


if "test/Courier-v0" not in gym.registry:
    gym.register("test/Courier-v0", entry_point=Courier, max_episode_steps=100)


def test_attempts_one_after_the_other_count_whether_they_end_soon_or_late():
    """If what is cut off was left out and all else counted, it would be 55 %."""
    found = evaluate(IDLE, task="test/Courier-v0", episodes=1000, num_envs=50)
    assert spread(found) < 4.0
    low, high = found.success.interval
    assert low < AT_FIRST < high
