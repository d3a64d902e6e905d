"""Rewards in units of what they add up to."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from corridor import Corridor
from stable_baselines3.common.vec_env import VecNormalize

from gazelle.training.learners import build_learner
from gazelle.training.learners.reward_scale import RewardScale
from gazelle.training.recipes import recipe_for
from gazelle.training.vecenv import VectorEnvAdapter

GAMMA = 0.9
RECIPE = dataclasses.replace(recipe_for("Unknown"), num_envs=6, net_arch=(16,))


def played(steps=60):
    """Return rewards and starts of some random steps, and Stable-Baselines3's variance of returns."""
    env = VecNormalize(
        VectorEnvAdapter(Corridor(6, limit=9)), norm_obs=False, gamma=GAMMA, clip_reward=10.0
    )
    env.reset()
    rng = np.random.default_rng(0)
    rewards, scaled, starts = [], [], [np.ones(6, np.bool_)]
    for _ in range(steps):
        _, paid, done, _ = env.step(rng.integers(3, size=6))
        rewards.append(env.get_original_reward())
        scaled.append(paid)
        starts.append(done)
    return np.array(rewards), np.array(starts[:-1]), np.array(scaled), float(env.ret_rms.var)


def test_returns_spread_as_stable_baselines3_has_them():
    rewards, starts, scaled, variance = played()
    scale = RewardScale(6, GAMMA)
    valid = np.ones(starts.shape, np.bool_)
    halves = [
        scale.scaled(rewards[part], starts[part], valid[part])
        for part in (slice(None, 30), slice(30, None))
    ]
    np.testing.assert_allclose(halves[1], rewards[30:] / np.sqrt(variance + 1e-8), rtol=1e-5)
    np.testing.assert_allclose(halves[1][-1], scaled[-1], rtol=1e-5)


def test_steps_spent_on_a_reset_do_not_count():
    rewards, starts, _, _ = played()
    paid, began = rewards[:, :1], starts[:, :1]
    expected = RewardScale(1, GAMMA).scaled(paid, began, np.ones(began.shape, np.bool_))
    # In the autoreset mode "next step" an episode begins with a step that is nobody's.
    before = np.flatnonzero(began)
    wide = np.insert(paid, before, 0.0, axis=0)
    valid = np.insert(np.ones(began.shape, np.bool_), before, False, axis=0)
    found = RewardScale(1, GAMMA).scaled(wide, ~valid, valid)
    np.testing.assert_allclose(found[valid], expected[:, 0])


def test_units_of_rewards_do_not_matter_to_a_users_task():
    taught = []
    for factor in (1.0, 500.0):
        recipe = dataclasses.replace(RECIPE, reward_scale=factor)
        env = VectorEnvAdapter(Corridor(6, limit=9), reward_scale=factor)
        learner = build_learner(recipe, env, seed=1)
        learner.learn(480)
        taught.append(learner.rollout_buffer.rewards.copy())
    np.testing.assert_allclose(taught[0], taught[1], rtol=1e-4)
    assert np.abs(taught[0]).max() <= 10.0 * (1.0 + RECIPE.gamma)


def test_rare_rewards_are_cut():
    rewards = np.zeros((100, 1), np.float32)
    rewards[50] = 1000.0
    scale = RewardScale(1, 0.0)
    none = np.zeros(rewards.shape, np.bool_)
    found = scale.scaled(rewards, none, ~none)
    assert found[50] == pytest.approx(10.0, rel=0.02)
