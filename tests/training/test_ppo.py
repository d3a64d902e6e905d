from __future__ import annotations

import dataclasses

import numpy as np
import pytest
import torch
from corridor import MODES, Corridor
from stable_baselines3.common.callbacks import BaseCallback

from gazelle.training.learners import build_learner
from gazelle.training.learners.ppo_update import NAMES, Weights, loss_of
from gazelle.training.recipes import PPOSettings, Recipe
from gazelle.training.threads import limit_threads
from gazelle.training.vecenv import VectorEnvAdapter

limit_threads(1)
RECIPE = Recipe(
    num_envs=6, net_arch=(16,), settings=PPOSettings(n_steps=40, batch_size=32, n_epochs=1)
)


class Quiet(BaseCallback):
    def _on_step(self):
        return True


def collected(mode="SameStep", *, continuous=False, recipe=RECIPE):
    env = Corridor(6, mode=mode, limit=9, continuous=continuous)
    adapter = VectorEnvAdapter(env, reward_scale=recipe.reward_scale)
    learner = build_learner(recipe, adapter, seed=1)
    _, callback = learner._setup_learn(10_000, Quiet())
    learner.collect_rollouts(learner.env, callback, learner.rollout_buffer, 40)
    return learner


@pytest.mark.parametrize("continuous", [False, True])
def test_rollout_holds_what_torch_would_have_computed(continuous):
    learner = collected(continuous=continuous)
    buffer = learner.rollout_buffer
    obs = torch.as_tensor(buffer.observations.reshape(-1, 3))
    actions = torch.as_tensor(buffer.actions.reshape(240, -1))
    if not continuous:
        actions = actions[:, 0]
    with torch.no_grad():
        values, log_probs, _ = learner.policy.evaluate_actions(obs, actions)
    np.testing.assert_allclose(buffer.values.reshape(-1), values.numpy()[:, 0], atol=1e-5)
    np.testing.assert_allclose(buffer.log_probs.reshape(-1), log_probs.numpy(), atol=1e-5)


@pytest.mark.parametrize("mode", MODES)
def test_advantages_equal_a_plain_computation_episode_by_episode(mode):
    """Recomputed copy by copy from the definition (Schulman et al. 2015, eq. 16)."""
    learner = collected(mode.value)
    buffer = learner.rollout_buffer
    gamma, lam = learner.gamma, learner.gae_lambda
    with torch.no_grad():
        last = learner.policy.predict_values(torch.as_tensor(learner._last_obs)).numpy()[:, 0]
    starts = np.vstack([buffer.episode_starts, learner._last_episode_starts])
    for slot in range(6):
        advantage, value_after = 0.0, last[slot]
        for row in reversed(range(40)):
            going_on = 1.0 - starts[row + 1, slot]
            delta = buffer.rewards[row, slot] + gamma * going_on * value_after
            delta -= buffer.values[row, slot]
            advantage = delta + gamma * lam * going_on * advantage
            assert buffer.advantages[row, slot] == pytest.approx(advantage, abs=1e-4)
            value_after = buffer.values[row, slot]


@pytest.mark.parametrize("mode", MODES)
def test_all_modes_teach_the_same(mode):
    """The valid transitions of an idle-step environment are those of the others, spread out."""
    learner = collected(mode.value)
    buffer = learner.rollout_buffer
    taught = len(buffer.transitions(learner.policy).returns)
    assert taught == int(buffer.valid.sum())
    data, order = buffer.transitions(learner.policy), buffer.new_order(taught)
    assert order.sort().values.tolist() == list(range(taught))
    batches = list(data.minibatches(order, 32))
    assert {len(batch.returns) for batch in batches[:-1]} == {32}
    for name in ("features", "actions", "log_probs", "advantages", "returns"):
        joined = torch.cat([getattr(batch, name) for batch in batches])
        assert torch.equal(joined, getattr(data, name)[order])
    assert (taught < 240) == (mode.value == "NextStep")


def test_cut_off_episodes_are_valued_where_they_were_cut():
    """With all rewards scaled to nothing, what is left is the discounted value."""
    still = dataclasses.replace(RECIPE, reward_scale=1e-30)
    learner = collected(recipe=still)
    buffer = learner.rollout_buffer
    rewarded = np.argwhere(np.abs(buffer.rewards) > 1e-20)
    assert len(rewarded) > 3
    for row, slot in rewarded:
        if row + 1 < 40:
            assert buffer.episode_starts[row + 1, slot]
        # The last observation shows a full clock, the position near where it was.
        before = buffer.observations[row, slot]
        assert before[2] == pytest.approx(8 / 9)
        move = buffer.actions[row, slot, 0] - 1.0
        final = np.array([before[0] + 0.1 * move, before[1], 1.0], dtype=np.float32)
        with torch.no_grad():
            value = learner.policy.predict_values(torch.as_tensor(final[None])).item()
        assert buffer.rewards[row, slot] == pytest.approx(learner.gamma * value, abs=1e-5)


def test_rewards_are_scaled_for_the_learner_only():
    recipe = dataclasses.replace(RECIPE, reward_scale=0.5)
    plain, scaled = collected(), collected(recipe=recipe)
    ended = plain.rollout_buffer.episode_starts
    inside = np.vstack([ended[1:], np.ones((1, 6))]) == 0
    np.testing.assert_allclose(
        scaled.rollout_buffer.rewards[inside], 0.5 * plain.rollout_buffer.rewards[inside]
    )


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("continuous", [False, True])
def test_the_update_has_the_gradient_that_the_library_would_take(continuous, mode):
    """Stable-Baselines3's own loss (its `PPO.train`), through its policy's own methods."""
    learner = collected(mode.value, continuous=continuous)
    buffer, policy = learner.rollout_buffer, learner.policy
    valid = buffer.valid.reshape(-1)
    flat = {
        name: torch.as_tensor(getattr(buffer, name).reshape(240, -1)[valid])
        for name in ("observations", "actions", "log_probs", "advantages", "returns")
    }
    # So that ratios are not all 1 and some are clipped.
    with torch.no_grad():
        for weight in policy.parameters():
            weight.add_(torch.randn_like(weight), alpha=0.3)
    actions = flat["actions"] if continuous else flat["actions"][:, 0]
    values, log_probs, entropy = policy.evaluate_actions(flat["observations"], actions)
    advantages = flat["advantages"][:, 0]
    advantages = (advantages - advantages.mean()) / (advantages.std() + 1e-8)
    ratio = (log_probs - flat["log_probs"][:, 0]).exp()
    gain = torch.min(advantages * ratio, advantages * ratio.clamp(0.8, 1.2)).mean()
    error = torch.nn.functional.mse_loss(flat["returns"][:, 0], values[:, 0])
    wanted = 0.5 * error - gain - 0.01 * entropy.mean()
    loss, told = loss_of(policy, buffer.transitions(policy), Weights(0.2, 0.01, 0.5))
    named = dict(zip(NAMES, told.tolist(), strict=True))
    assert loss.item() == pytest.approx(wanted.item(), rel=1e-4)
    assert named["policy_gradient_loss"] == pytest.approx(-gain.item(), abs=1e-5)
    assert named["value_loss"] == pytest.approx(error.item(), rel=1e-4)
    assert named["entropy_loss"] == pytest.approx(-entropy.mean().item(), rel=1e-4)
    assert 0.0 < named["clip_fraction"] < 1.0
    weights = list(policy.parameters())
    for ours, theirs in zip(
        torch.autograd.grad(loss, weights), torch.autograd.grad(wanted, weights), strict=True
    ):
        np.testing.assert_allclose(ours.numpy(), theirs.numpy(), rtol=1e-3, atol=1e-5)


@pytest.mark.parametrize("features", [False, True])
def test_the_library_loads_a_saved_model_and_goes_on_with_it(tmp_path, features):
    from stable_baselines3 import PPO

    learner = collected(recipe=dataclasses.replace(RECIPE, features=features))
    learner.train()
    learner.save(tmp_path / "model.zip")
    plain = PPO.load(tmp_path / "model.zip", env=VectorEnvAdapter(Corridor(6, limit=9)))
    seen = np.random.default_rng(0).uniform(-1.0, 1.0, (20, 3)).astype(np.float32)
    wanted = learner.predict(seen, deterministic=True)[0]
    np.testing.assert_array_equal(plain.predict(seen, deterministic=True)[0], wanted)
    plain.learn(240)
    assert plain.num_timesteps >= 240


@pytest.mark.parametrize("bfloat16", [False, True])
def test_learning_leaves_torchs_precision_as_it_was(bfloat16):
    before = torch.get_float32_matmul_precision()
    settings = dataclasses.replace(RECIPE.settings, bfloat16=bfloat16)
    collected(recipe=dataclasses.replace(RECIPE, settings=settings)).train()
    assert torch.get_float32_matmul_precision() == before
