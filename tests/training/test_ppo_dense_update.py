from __future__ import annotations

import dataclasses

import numpy as np
import pytest
import torch
from corridor import Corridor
from stable_baselines3.common.callbacks import BaseCallback

from gazelle.training.learners import build_learner, ppo
from gazelle.training.learners.ppo_dense_update import DenseUpdate, fits_dense_update
from gazelle.training.learners.ppo_update import NAMES, Weights
from gazelle.training.recipes import PPOSettings, Recipe
from gazelle.training.threads import limit_threads
from gazelle.training.vecenv import VectorEnvAdapter

limit_threads(1)
WEIGHTS = Weights(0.2, 0.01, 0.5)
RECIPE = Recipe(
    num_envs=6,
    net_arch=(16, 12),
    learning_rate=0.01,
    settings=PPOSettings(n_steps=40, batch_size=64, n_epochs=3, ent_coef=0.01),
)


class Quiet(BaseCallback):
    def _on_step(self):
        return True


def made(*, continuous=False, **changes):
    env = Corridor(6, mode="SameStep", limit=9, continuous=continuous)
    learner = build_learner(
        dataclasses.replace(RECIPE, **changes), VectorEnvAdapter(env, reward_scale=1.0), seed=1
    )
    _, callback = learner._setup_learn(10_000, Quiet())
    return learner, callback


def updated(monkeypatch, *, dense, rollouts=3, **options):
    """Return weights, moments and curves after some updates, in the one way or the other."""
    if not dense:
        monkeypatch.setattr(ppo, "fits_dense_update", lambda policy: False)
    learner, callback = made(**options)
    for _ in range(rollouts):
        learner.collect_rollouts(learner.env, callback, learner.rollout_buffer, 40)
        learner.train()
    monkeypatch.undo()
    return learner


@pytest.mark.parametrize("continuous", [False, True])
@pytest.mark.parametrize("activation", ["tanh", "relu"])
@pytest.mark.parametrize("net_arch", [(16, 12), (8,), ()])
def test_updates_equal_those_by_recorded_gradients(monkeypatch, continuous, activation, net_arch):
    options = {"continuous": continuous, "activation": activation, "net_arch": net_arch}
    ours = updated(monkeypatch, dense=True, **options)
    theirs = updated(monkeypatch, dense=False, **options)
    for name, weight in ours.policy.state_dict().items():
        other = theirs.policy.state_dict()[name]
        np.testing.assert_allclose(weight.numpy(), other.numpy(), rtol=1e-3, atol=2e-4)
    mine, other = (each.policy.optimizer.state_dict()["state"] for each in (ours, theirs))
    assert mine.keys() == other.keys()
    for number in mine:
        assert mine[number].keys() == other[number].keys()
        assert mine[number]["step"] == other[number]["step"] > 0
        for name in ("exp_avg", "exp_avg_sq"):
            np.testing.assert_allclose(
                mine[number][name].numpy(), other[number][name].numpy(), rtol=0.02, atol=1e-4
            )
    for name in NAMES:
        curves = [each.logger.name_to_value[f"train/{name}"] for each in (ours, theirs)]
        assert curves[0] == pytest.approx(curves[1], rel=0.02, abs=1e-3)


@pytest.mark.parametrize("continuous", [False, True])
def test_one_step_with_ratios_that_are_clipped(continuous):
    """A step of the recorded kind from the same weights moves them by the same."""
    learner, callback = made(continuous=continuous)
    learner.collect_rollouts(learner.env, callback, learner.rollout_buffer, 40)
    with torch.no_grad():
        for weight in learner.policy.parameters():
            weight.add_(torch.randn_like(weight), alpha=0.3)
    before = [weight.detach().clone() for weight in learner.policy.parameters()]
    data = learner.rollout_buffer.transitions(learner.policy)
    dense = DenseUpdate(learner.policy, learner.max_grad_norm)
    told = dense.learn_from(data, WEIGHTS)
    shown = learner._learn_from(data, WEIGHTS)
    np.testing.assert_allclose(told.numpy(), shown.detach().numpy(), rtol=1e-4, atol=1e-5)
    assert 0.05 < told[NAMES.index("clip_fraction")] < 0.95
    theirs = [weight.detach().clone() for weight in learner.policy.parameters()]
    learner.policy.optimizer.state.clear()
    for weight, old in zip(learner.policy.parameters(), before, strict=True):
        weight.data.copy_(old)
    dense.finish()
    for weight, other in zip(learner.policy.parameters(), theirs, strict=True):
        np.testing.assert_allclose(weight.detach().numpy(), other.numpy(), atol=1e-5)


@pytest.mark.parametrize("activation", ["tanh", "relu"])
def test_bfloat16_gives_the_same_gradients_but_for_rounding(activation):
    learner, callback = made(activation=activation)
    learner.collect_rollouts(learner.env, callback, learner.rollout_buffer, 40)
    data = learner.rollout_buffer.transitions(learner.policy)
    found = []
    for rounded in (False, True):
        dense = DenseUpdate(learner.policy, learner.max_grad_norm, bfloat16=rounded)
        features = data.features.bfloat16() if rounded else data.features
        told = dense.learn_from(dataclasses.replace(data, features=features), WEIGHTS)
        found.append((dense._gradients, told))
    (exact, shown), (near, other) = found
    assert not torch.equal(exact, near)
    assert torch.linalg.vector_norm(near - exact) < 0.02 * torch.linalg.vector_norm(exact)
    np.testing.assert_allclose(other.numpy(), shown.numpy(), rtol=0.02, atol=2e-3)


def test_updates_in_bfloat16_are_those_of_processors_that_multiply_it(monkeypatch):
    made_with = []

    class Watched(DenseUpdate):
        def __init__(self, *arguments, bfloat16=False):
            made_with.append(bfloat16)
            super().__init__(*arguments, bfloat16=bfloat16)

    monkeypatch.setattr(ppo, "DenseUpdate", Watched)
    for able in (True, False):
        monkeypatch.setattr(ppo, "multiplies_bfloat16", lambda able=able: able)
        for wanted in (True, False):
            settings = dataclasses.replace(RECIPE.settings, bfloat16=wanted)
            learner, callback = made(settings=settings)
            learner.collect_rollouts(learner.env, callback, learner.rollout_buffer, 40)
            learner.train()
    assert made_with == [True, False, False, False]


def test_what_it_does_not_know_is_left_to_recorded_gradients():
    learner, _ = made()
    policy = learner.policy
    assert fits_dense_update(policy)
    policy.optimizer.param_groups[0]["weight_decay"] = 0.1
    assert not fits_dense_update(policy)
    policy.optimizer.param_groups[0]["weight_decay"] = 0
    policy.extra = torch.nn.Linear(2, 2)
    assert not fits_dense_update(policy)
    del policy.extra
    policy.mlp_extractor.policy_net.append(torch.nn.Dropout())
    assert not fits_dense_update(policy)
