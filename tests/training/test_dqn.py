"""DQN: equal to Stable-Baselines3's own, and Double DQN."""

from __future__ import annotations

import copy

import numpy as np
import pytest
import torch
from corridor import Corridor
from stable_baselines3 import DQN
from stable_baselines3.common.type_aliases import ReplayBufferSamples

from gazelle.training import OffPolicySettings, Recipe
from gazelle.training.learners import build_learner
from gazelle.training.vecenv import VectorEnvAdapter


@pytest.fixture(scope="module")
def env():
    made = VectorEnvAdapter(Corridor(4, mode="SameStep", limit=9))
    yield made
    made.close()


def learner_of(env, **settings):
    """Return a learner with a memory of a short training."""
    given = {"buffer_size": 400, "batch_size": 32, "learning_starts": 8} | settings
    recipe = Recipe(
        algo="dqn", net_arch=(16,), learning_rate_decay=False, settings=OffPolicySettings(**given)
    )
    return build_learner(recipe, env, seed=1).learn(200, log_interval=None)


def learnt(learner, train, start):
    """Return the weights after some minibatches from the same state."""
    learner.policy.load_state_dict(start)
    learner.policy.optimizer.state.clear()
    np.random.seed(4)  # noqa: NPY002  # the memory draws from the global generator
    train(learner, gradient_steps=6, batch_size=32)
    return {name: value.clone() for name, value in learner.policy.state_dict().items()}


@pytest.mark.parametrize("n_steps", [1, 3])
def test_an_update_is_stable_baselines_own(env, n_steps):
    learner = learner_of(env, n_steps=n_steps)
    start = copy.deepcopy(learner.policy.state_dict())
    ours, theirs = (learnt(learner, kind.train, start) for kind in (type(learner), DQN))
    for name, value in ours.items():
        np.testing.assert_allclose(value, theirs[name], atol=1e-6, err_msg=name)
    assert any(not torch.equal(value, start[name]) for name, value in ours.items())


def test_the_network_that_learns_chooses_what_double_q_values(env):
    learner = learner_of(env, double_q=True)
    obs = torch.as_tensor(env.reset())
    nothing = torch.zeros((len(obs), 1))
    batch = ReplayBufferSamples(obs, nothing, obs, nothing, nothing, None)
    with torch.no_grad():
        learner.q_net.q_net[-1].bias.copy_(torch.tensor([50.0, 0.0, 0.0]))
        learner.q_net_target.q_net[-1].bias.copy_(torch.tensor([0.0, 0.0, 50.0]))
        valued = learner.q_net_target(obs)
    target = learner._target(batch)
    np.testing.assert_allclose(target, 0.98 * valued[:, :1], rtol=1e-6)
    assert (target < 0.98 * valued.amax(dim=1, keepdim=True)).all()
