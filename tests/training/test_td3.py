"""DDPG and TD3 that learn faster: equal to Stable-Baselines3's own, and what they add."""

from __future__ import annotations

import copy
import dataclasses

import numpy as np
import pytest
import slider_task
import torch
from stable_baselines3 import DDPG, TD3

from gazelle.errors import TaskError
from gazelle.training import OffPolicySettings, Recipe
from gazelle.training.export import export_actor
from gazelle.training.learners import build_learner
from gazelle.training.vecenv import VectorEnvAdapter

THEIRS = {"ddpg": DDPG, "td3": TD3}


def recipe(algo="ddpg", settings=None, **changes):
    given = {"buffer_size": 400, "batch_size": 32, "learning_starts": 8} | (settings or {})
    return Recipe(
        algo=algo,
        num_envs=4,
        net_arch=(16, 16),
        activation="relu",
        gamma=0.9,
        settings=OffPolicySettings(**given),
        **changes,
    )


@pytest.fixture(scope="module")
def env():
    made = VectorEnvAdapter(slider_task.SliderVectorEnv(4))
    yield made
    made.close()


def learner_of(env, given, steps=120):
    """Return a learner whose memory holds some steps of random actions."""
    torch.manual_seed(0)
    env.seed(3)
    learner = build_learner(given, env, seed=1)
    learner._setup_learn(1000, callback=None)
    obs, rng = env.reset(), np.random.default_rng(0)
    for _ in range(steps // 4):
        actions = rng.uniform(-1.0, 1.0, (4, 2)).astype(np.float32)
        after, rewards, dones, infos = env.step(actions)
        following = after.copy()
        for slot in np.flatnonzero(dones):
            following[slot] = infos[slot]["terminal_observation"]
        learner.replay_buffer.add(obs, following, actions, rewards, dones, infos)
        obs = after
    return learner


def weights(policy):
    return {name: value.clone() for name, value in policy.state_dict().items()}


@pytest.mark.parametrize("algo", ["ddpg", "td3"])
@pytest.mark.parametrize("features", [False, True])
def test_an_update_is_stable_baselines_own(env, algo, features):
    learner = learner_of(env, recipe(algo, goal_differences=features))
    start = copy.deepcopy(learner.policy.state_dict())
    found = []
    for train in (type(learner).train, THEIRS[algo].train):
        learner.policy.load_state_dict(start)
        learner.scale.refresh()
        for optimizer in (learner.actor.optimizer, learner.critic.optimizer):
            optimizer.state.clear()
        learner._n_updates = 0
        np.random.seed(4)  # noqa: NPY002  # the memory draws from the global generator
        torch.manual_seed(4)
        train(learner, gradient_steps=6, batch_size=32)
        found.append(weights(learner.policy))
    for name, value in found[0].items():
        np.testing.assert_allclose(value, found[1][name], atol=2e-5, err_msg=name)
    assert not torch.equal(found[0]["actor.mu.0.weight"], start["actor.mu.0.weight"])


def test_targets_stay_within_what_rewards_can_add_up_to(env):
    learner = learner_of(env, recipe(settings={"bound_values": True}))
    for bias, wanted in ((1000.0, 0.0), (-1000.0, -10.0)):
        with torch.no_grad():
            learner.critic_target.q_networks[0][-1].bias.fill_(bias)
        target = learner._target(learner.replay_buffer.sample(64))
        np.testing.assert_allclose(target, wanted, atol=1e-5)
    free = learner_of(env, recipe())
    with torch.no_grad():
        free.critic_target.q_networks[0][-1].bias.fill_(1000.0)
    assert (free._target(free.replay_buffer.sample(8)) > 100.0).all()


@pytest.mark.long
def test_large_actions_have_a_price(env):
    size = {}
    for price in (0.0, 50.0):
        learner = learner_of(env, recipe(settings={"action_penalty": price}, learning_rate=1e-2))
        learner.train(gradient_steps=60, batch_size=64)
        batch = learner.replay_buffer.sample(200)
        size[price] = learner.actor(batch.observations).square().mean().item()
    assert size[50.0] < 0.2 * size[0.0]
    assert size[50.0] < 0.02


def test_so_many_actions_are_drawn_evenly(env):
    learner = learner_of(env, recipe(settings={"random_actions": 0.3, "action_noise": 0.0}))
    learner.num_timesteps, learner._last_obs = 1000, env.obs
    told, _ = learner.predict(env.obs, deterministic=True)
    np.random.seed(2)  # noqa: NPY002  # the learner draws from the global generator
    drawn = []
    for _ in range(500):
        actions, kept = learner._sample_action(0, learner.action_noise, 4)
        np.testing.assert_allclose(actions, kept, atol=1e-6)  # bounds are -1 and 1
        drawn += list(actions[np.abs(actions - told).max(axis=1) > 1e-6])
    assert len(drawn) / 2000 == pytest.approx(0.3, abs=0.03)
    assert np.std(drawn, axis=0) == pytest.approx(np.full(2, 1 / np.sqrt(3)), abs=0.04)


def test_hidden_layers_in_bfloat16_learn_about_the_same(env):
    found = []
    for short in (False, True):
        learner = learner_of(env, recipe(settings={"bfloat16": short}))
        np.random.seed(4)  # noqa: NPY002
        learner.train(gradient_steps=10, batch_size=64)
        seen = learner.replay_buffer.sample(100).observations
        found.append(learner._outputs(learner.actor.mu, learner.actor.features_extractor(seen)))
    assert found[0].dtype == found[1].dtype == torch.float32
    np.testing.assert_allclose(found[0].detach(), found[1].detach(), atol=0.05)
    assert not torch.equal(found[0], found[1])


@pytest.mark.parametrize("cut", [None, 1.5])
@pytest.mark.parametrize("algo", ["ddpg", "td3", "sac"])
def test_goals_differences_are_part_of_the_exported_first_layer(env, algo, cut):
    learner = learner_of(env, recipe(algo, goal_differences=True, cut_observations=cut))
    learner.scale.refresh()
    entries = env.observation_space.shape[0]
    assert learner.actor.features_extractor.features_dim == entries + 2
    actor = export_actor(learner.policy)
    assert actor.inputs == entries
    seen = learner.replay_buffer.sample(50).observations.numpy()
    seen[::5] *= 30.0
    wanted, _ = learner.predict(seen, deterministic=True)
    np.testing.assert_allclose(actor.act(seen), wanted, atol=1e-5)


def test_differences_of_goals_need_goals():
    from corridor import Corridor

    env = VectorEnvAdapter(Corridor(4, continuous=True, bound=1.0))
    with pytest.raises(TaskError, match="no goals, so there are no differences"):
        build_learner(recipe(goal_differences=True), env, seed=0)
    env.close()


def test_the_policy_may_learn_less_often(env):
    learner = learner_of(env, recipe(settings={"policy_delay": 3}))
    before = weights(learner.actor)
    learner.train(gradient_steps=2, batch_size=8)
    assert torch.equal(learner.actor.state_dict()["mu.0.weight"], before["mu.0.weight"])
    learner.train(gradient_steps=1, batch_size=8)
    assert not torch.equal(learner.actor.state_dict()["mu.0.weight"], before["mu.0.weight"])
    with pytest.raises(TaskError, match="hindsight_redraw must be"):
        dataclasses.replace(recipe(), hindsight_redraw=-0.1)
