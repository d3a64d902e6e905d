"""Stable-Baselines3's PPO with faster ways to collect rollouts and to learn from them.

Acting is done by a numpy copy of the actor, values are computed for the whole
rollout at once, no Python object is made for each copy of the environment, and
updates work on whole tensors (`ppo_update`, or `dense_update` where the networks allow it, then if wanted
beside the next rollout, see `update_ahead`). Steps that an environment spends on its reset are left out of the update.
"""

from __future__ import annotations

import contextlib
import dataclasses
import math
from collections.abc import Mapping
from typing import Any

import gymnasium as gym
import numpy as np
import numpy.typing as npt
import torch
from stable_baselines3 import PPO
from stable_baselines3.common.buffers import RolloutBuffer
from stable_baselines3.common.utils import explained_variance

from gazelle.array_types import Floats32
from gazelle.errors import TaskError
from gazelle.training.actor import Actor
from gazelle.training.export import export_actor
from gazelle.training.learners.arguments import Learner, common_arguments
from gazelle.training.learners.ppo_dense_update import DenseUpdate, fits_dense_update
from gazelle.training.learners.ppo_overlapped_update import OverlappedUpdate
from gazelle.training.learners.ppo_update import (
    NAMES,
    Transitions,
    Weights,
    learns_features,
    loss_of,
)
from gazelle.training.learners.reward_scale import RewardScale
from gazelle.training.recipes import PPOSettings, Recipe
from gazelle.training.rollout import CutOff, Rollout
from gazelle.training.scaling import ObservationScale
from gazelle.training.threads import multiplies_bfloat16, products, short_turns
from gazelle.training.vecenv import VectorEnvAdapter

_MORE_NAMES = ("explained_variance", "clip_range")
_TOGETHER = 4096  # observations that are valued at once: pictures of a whole rollout are large


class MaskedRolloutBuffer(RolloutBuffer):  # type: ignore[misc]  # untyped base
    """A rollout buffer that gives only the valid transitions to the learner.

    Attributes:
        valid: Mask of valid transitions, shape (steps, copies).
        rng: Random generator of the order of the minibatches.
    """

    valid: npt.NDArray[np.bool_]
    rng: np.random.Generator

    def transitions(self, policy: Any) -> Transitions:
        """Return the valid transitions, with observations in the form of the policy's networks."""
        valid = torch.as_tensor(self.valid.reshape(-1))
        observations = self._flat(self.observations)[valid]
        actions = self._flat(self.actions)[valid]
        if isinstance(self.action_space, gym.spaces.Discrete):
            actions = actions[:, 0].long()
        features = observations
        if not learns_features(policy):
            with torch.no_grad():
                features = policy.features_extractor(observations)
        return Transitions(
            features,
            actions,
            self._flat(self.log_probs)[valid],
            self._flat(self.advantages)[valid],
            self._flat(self.returns)[valid],
        )

    def new_order(self, count: int) -> torch.Tensor:
        """Return a random order of a given number of transitions."""
        return torch.as_tensor(self.rng.permutation(count))

    def _flat(self, array: npt.NDArray[Any]) -> torch.Tensor:
        return torch.as_tensor(array.reshape(array.shape[0] * array.shape[1], *array.shape[2:]))


class FastPPO(PPO):  # type: ignore[misc]  # untyped base
    """PPO for a `VectorEnvAdapter`; see the module's text for what differs."""

    env: VectorEnvAdapter
    scale: ObservationScale
    bfloat16: bool = False
    overlap: bool = False
    ahead: OverlappedUpdate | None = None
    reward_scale: RewardScale | None = None
    _last_obs: Floats32
    _last_episode_starts: npt.NDArray[np.bool_]

    @staticmethod
    def _wrap_env(env: VectorEnvAdapter, *_arguments: Any, **_options: Any) -> VectorEnvAdapter:
        """Return the environment unchanged: episodes and picture axes are handled elsewhere."""
        return env

    def _setup_model(self) -> None:
        self.rollout_buffer_class = MaskedRolloutBuffer
        super()._setup_model()
        self.action_rng = np.random.default_rng(self.seed)
        self.rollout_buffer.rng = np.random.default_rng(self.seed)

    def collect_rollouts(
        self,
        env: VectorEnvAdapter,
        callback: Any,
        rollout_buffer: MaskedRolloutBuffer,
        n_rollout_steps: int,
    ) -> bool:
        """Fill the buffer with ``n_rollout_steps`` control steps of every copy.

        Returns:
            False if the callback stops the training.
        """
        callback.on_rollout_start()
        self.policy.set_training_mode(False)
        actor = export_actor(self.policy)

        def counted() -> bool:
            self.num_timesteps += env.num_envs
            return bool(callback.on_step())

        met = env.collect(actor, n_rollout_steps, rng=self.action_rng, on_step=counted)
        if met is None:
            return False
        # What was played with the old weights is valued and learnt from with the new ones.
        self._apply_update()
        self._last_obs, self._last_episode_starts = met.last_obs, met.last_starts
        outputs = met.outputs
        if not self.scale.decided and self.scale.refresh():
            # The first rollout shows how to scale: learn from it as if it had been known.
            actor = export_actor(self.policy)
            flat = met.observations.reshape(n_rollout_steps * env.num_envs, -1)
            outputs = actor.outputs(flat).reshape(outputs.shape)
        self._fill(rollout_buffer, met)
        if self.reward_scale is not None:
            scaled = self.reward_scale.scaled(met.rewards, met.starts, met.valid)
            rollout_buffer.rewards[:] = scaled
        rollout_buffer.log_probs[:] = _log_probs(actor, outputs, rollout_buffer.actions)
        self._finish(rollout_buffer, met.cut_off)
        callback.on_rollout_end()
        return True

    @staticmethod
    def _fill(buffer: MaskedRolloutBuffer, met: Rollout) -> None:
        buffer.reset()
        buffer.observations[:] = met.observations
        buffer.actions[:] = met.actions
        buffer.rewards[:] = met.rewards
        buffer.episode_starts[:] = met.starts
        buffer.valid = met.valid

    def learn(self, *arguments: Any, **options: Any) -> FastPPO:
        """Train like Stable-Baselines3's; no update is running when it returns or raises."""
        try:
            with short_turns(enabled=self.overlap):
                super().learn(*arguments, **options)
        except BaseException:
            if self.ahead is not None:
                with contextlib.suppress(Exception):  # only the first error is reported
                    self.ahead.wait()
            raise
        self._apply_update()
        return self

    def train(self) -> None:
        """Train on the rollout, or start to if updates run ahead; see `OverlappedUpdate`."""
        self.policy.set_training_mode(True)
        self._update_learning_rate(self.policy.optimizer)
        weights = Weights(
            self.clip_range(self._current_progress_remaining), self.ent_coef, self.vf_coef
        )
        data = self.rollout_buffer.transitions(self.policy)
        orders = [self.rollout_buffer.new_order(len(data.returns)) for _ in range(self.n_epochs)]
        explained = explained_variance(
            self.rollout_buffer.values.flatten(), self.rollout_buffer.returns.flatten()
        )
        dense = self._dense_update() if fits_dense_update(self.policy) else None
        if dense is not None and dense.bfloat16:
            data = dataclasses.replace(data, features=data.features.bfloat16())
        step = self._learn_from if dense is None else dense.learn_from

        def learn() -> list[float]:
            figures = [
                step(batch, weights)
                for order in orders
                for batch in data.minibatches(order, self.batch_size)
            ]
            means: list[float] = torch.stack(figures).mean(dim=0).tolist()
            return [*means, explained, weights.clip_range]

        if dense is None:
            with products(bfloat16=self.bfloat16):
                self._end_update(learn())
            return
        self.ahead = OverlappedUpdate(dense, learn)
        self.ahead.start()
        if not self.overlap:
            self._apply_update()

    def _dense_update(self) -> DenseUpdate:
        """Return an update of the policy's weights as they are now."""
        rounded = self.bfloat16 and multiplies_bfloat16()
        return DenseUpdate(self.policy, self.max_grad_norm, bfloat16=rounded)

    def resume_update(self, state: Mapping[str, Any]) -> None:
        """Restore an update to hand over, from `OverlappedUpdate.get_state`, as in a checkpoint."""
        self.ahead = OverlappedUpdate.from_state(self._dense_update(), state)

    def _apply_update(self) -> None:
        """Apply the running update's result to the policy, if there is one."""
        if self.ahead is not None:
            figures = self.ahead.apply()
            self.ahead = None
            self._end_update(figures)

    def _end_update(self, figures: list[float]) -> None:
        """Record an update, then scale observations by all that were seen so far."""
        self._n_updates += self.n_epochs
        self._record(figures)
        self.scale.refresh()

    def _learn_from(self, batch: Transitions, weights: Weights) -> torch.Tensor:
        """Update the policy by one step; returns what the curves show of it."""
        loss, figures = loss_of(self.policy, batch, weights)
        self.policy.optimizer.zero_grad()
        torch.autograd.backward(loss)
        torch.nn.utils.clip_grad_norm_(self.policy.parameters(), self.max_grad_norm)
        self.policy.optimizer.step()
        return figures

    def _record(self, figures: list[float]) -> None:
        """Record the curves under Stable-Baselines3's names."""
        for name, value in zip((*NAMES, *_MORE_NAMES), figures, strict=True):
            self.logger.record(f"train/{name}", value)
        if hasattr(self.policy, "log_std"):
            self.logger.record("train/std", self.policy.log_std.exp().mean().item())
        self.logger.record("train/n_updates", self._n_updates, exclude="tensorboard")

    def _finish(self, buffer: MaskedRolloutBuffer, cut_off: CutOff) -> None:
        """Compute values, bootstrapped rewards of truncated episodes (Pardo et al.

        2018), advantages. 2018), advantages.
        """
        rows, copies = buffer.rewards.shape
        flat = buffer.observations.reshape(rows * copies, *buffer.obs_shape)
        buffer.values[:] = self._values(flat).reshape(rows, copies)
        if len(cut_off.rows):
            values = self._values(cut_off.final_obs)
            buffer.rewards[cut_off.rows, cut_off.slots] += self.gamma * values
        buffer.pos, buffer.full = rows, True
        last_values = torch.as_tensor(self._values(self._last_obs))
        buffer.compute_returns_and_advantage(last_values, self._last_episode_starts)

    def _values(self, obs: Floats32) -> Floats32:
        with torch.no_grad():
            whole = torch.as_tensor(obs)
            size = _TOGETHER if learns_features(self.policy) else max(1, len(whole))
            parts = [whole[first : first + size] for first in range(0, len(whole), size)]
            values: Floats32 = torch.cat([self.policy.predict_values(x) for x in parts]).numpy()
        return values.reshape(-1)


def _log_probs(actor: Actor, outputs: Floats32, actions: npt.NDArray[Any]) -> Floats32:
    """Return log-probabilities of all actions of a rollout, shape (steps, copies)."""
    rows, copies, width = outputs.shape
    flat = actions.reshape(rows * copies, -1)
    if actor.discrete:
        flat = flat[:, 0].astype(np.int64)
    return actor.log_prob(outputs.reshape(-1, width), flat).reshape(rows, copies)


def build_ppo(recipe: Recipe, env: VectorEnvAdapter, seed: int) -> Learner:
    """Return a learner for an environment.

    Raises:
        TaskError: The recipe has settings of another algorithm.
    """
    settings = recipe.settings
    if not isinstance(settings, PPOSettings):
        raise TaskError("a recipe for ppo needs PPOSettings")
    common = common_arguments(recipe, env, seed)
    # SB3's own epsilon for PPO; the fused kernel is one call instead of many.
    common["policy_kwargs"]["optimizer_kwargs"] = {"eps": 1e-5, "fused": True}
    common["policy_kwargs"]["log_std_init"] = math.log(settings.initial_std)
    learner = FastPPO(
        "MlpPolicy",
        env,
        n_steps=settings.n_steps,
        batch_size=min(settings.batch_size, settings.n_steps * env.num_envs),
        n_epochs=settings.n_epochs,
        gae_lambda=settings.gae_lambda,
        clip_range=settings.clip_range,
        ent_coef=settings.ent_coef,
        vf_coef=settings.vf_coef,
        max_grad_norm=settings.max_grad_norm,
        **common,
    )
    learner.bfloat16 = settings.bfloat16
    learner.overlap = settings.overlap
    if settings.scale_rewards:
        learner.reward_scale = RewardScale(env.num_envs, recipe.gamma)
    return learner
