"""DDPG and TD3 with an update that costs a processor less and that goals far away do not upset.

What Stable-Baselines3 computes (T. P. Lillicrap et al., "Continuous control with deep reinforcement
learning", 2015, arXiv 1509.02971; S. Fujimoto et al., "Addressing Function Approximation Error in
Actor-Critic Methods", 2018, arXiv 1802.09477), and besides, as M. Plappert et al., "Multi-Goal
Reinforcement Learning", 2018, arXiv 1802.09464, learn goals: values stay within what rewards can
add up to, large actions have a price, and some actions are drawn evenly. And what a demonstrator did
before the first update is imitated, see `gazelle.training.demonstrations`.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt
import torch
from stable_baselines3 import TD3

from gazelle.training.demonstrations import Demonstrator, find_demonstrator, shown_actions
from gazelle.training.learners.actor_critic import CriticUpdate, follow, frozen
from gazelle.training.learners.arguments import (
    Learner,
    noisy_arguments,
    off_policy_settings,
)
from gazelle.training.learners.replay import targets
from gazelle.training.recipes import Recipe
from gazelle.training.vecenv import VectorEnvAdapter

_SHOWN = 4  # of a minibatch one of this number is a demonstration
_STEADY = 0.5  # of the noise that a demonstrator's actions get


class _Imitated(NamedTuple):
    """Observations of a demonstrator, shape (n, entries), and its actions, shape (n, actions)."""

    features: torch.Tensor
    actions: torch.Tensor


class DeterministicLearner(CriticUpdate, TD3):  # type: ignore[misc]  # untyped base
    """Base of `FastDDPG` and `FastTD3`.

    Attributes:
        demonstrator: Acts before the first update, if set.
        least_reward: The least that was learnt from so far, 0 at most.
        greatest_reward: The greatest, 0 at least.
    """

    demonstrator: Demonstrator | None = None
    least_reward: float = 0.0
    greatest_reward: float = 0.0

    def train(self, gradient_steps: int, batch_size: int = 100) -> None:
        """Train on a given number of minibatches."""
        # The memory holds observations as they were, so all that is learnt from is scaled alike.
        self.scale.refresh()
        self.policy.set_training_mode(True)
        self._update_learning_rate([self.actor.optimizer, self.critic.optimizer])
        critic_loss = actor_loss = torch.zeros(())
        for _ in range(gradient_steps):
            self._n_updates += 1
            batch = self.replay_buffer.sample(batch_size)
            features = self.actor.features_extractor(batch.observations)
            critic_loss = self._improve_critic(features, batch)
            if self._n_updates % self.policy_delay == 0:
                actor_loss = self._improve_actor(features, self._shown(batch_size))
                self._follow()
        self.logger.record("train/n_updates", self._n_updates, exclude="tensorboard")
        self.logger.record("train/actor_loss", actor_loss.item())
        self.logger.record("train/critic_loss", critic_loss.item())

    @torch.no_grad()
    def _target(self, batch: Any) -> torch.Tensor:
        """Return the critics' target values, shape (n, 1)."""
        following = self.actor.features_extractor(batch.next_observations)
        actions = self._outputs(self.actor_target.mu, following)
        if self.target_policy_noise:
            noise = torch.randn_like(actions) * self.target_policy_noise
            noise = noise.clamp(-self.target_noise_clip, self.target_noise_clip)
            actions = (actions + noise).clamp(-1.0, 1.0)
        value = self._least_value(self.critic_target, following, actions)
        target = targets(batch, value, self.gamma)
        if not self.ways.bound_values or self.gamma >= 1.0:
            return target
        self.least_reward = min(self.least_reward, batch.rewards.min().item())
        self.greatest_reward = max(self.greatest_reward, batch.rewards.max().item())
        horizon = 1.0 / (1.0 - self.gamma**self.ways.n_steps)
        return target.clamp(self.least_reward * horizon, self.greatest_reward * horizon)

    def _improve_actor(self, features: torch.Tensor, shown: _Imitated | None) -> torch.Tensor:
        """Update the actor by one step; returns its loss.

        Args:
            features: Of the minibatch, shape (n, entries).
            shown: Demonstrations to imitate, if any.
        """
        count = len(features)
        seen = features if shown is None else torch.cat((features, shown.features))
        outputs = self._outputs(self.actor.mu, seen)
        critic = self.critic.q_networks[0]
        with frozen(critic.parameters()):
            values = self._outputs(critic, torch.cat((seen, outputs), dim=1))
        loss = self.ways.action_penalty * outputs[:count].square().mean() - values[:count].mean()
        if shown is not None:
            with torch.no_grad():
                better = self._outputs(critic, torch.cat(shown, dim=1)) > values[count:]
            missed = (outputs[count:] - shown.actions) * better
            loss = loss + self.ways.imitation * missed.square().mean()
        self.actor.optimizer.zero_grad()
        torch.autograd.backward(loss)
        self.actor.optimizer.step()
        return loss.detach()

    def _shown(self, batch_size: int) -> _Imitated | None:
        """Return a share of what a demonstrator did, as far as it is remembered."""
        if self.demonstrator is None or not self.ways.imitation:
            return None
        rows = -(-self.learning_starts // self.n_envs)
        batch = self.replay_buffer.sample_first(batch_size // _SHOWN, rows)
        if batch is None:
            return None
        return _Imitated(self.actor.features_extractor(batch.observations), batch.actions)

    @torch.no_grad()
    def _follow(self) -> None:
        """Update the target networks."""
        follow(self.critic_target, self.critic, self.tau)
        follow(self.actor_target, self.actor, self.tau)

    def _sample_action(
        self, learning_starts: int, action_noise: Any = None, n_envs: int = 1
    ) -> tuple[npt.NDArray[Any], npt.NDArray[Any]]:
        """Return actions for the environment and for the memory: shown, or some random ones."""
        if self.num_timesteps < learning_starts and self.demonstrator is not None:
            shape = n_envs, *self.action_space.shape
            shown = shown_actions(self.demonstrator, self._last_obs, shape)
            kept = self.policy.scale_action(shown)
            noise = self.ways.action_noise * np.random.standard_normal(shape)  # noqa: NPY002
            kept = np.clip(kept + _STEADY * noise, -1.0, 1.0).astype(np.float32)
            return self.policy.unscale_action(kept), kept
        actions, kept = super()._sample_action(learning_starts, action_noise, n_envs)
        if self.ways.random_actions and self.num_timesteps >= learning_starts:
            anyhow = np.random.random_sample(n_envs) < self.ways.random_actions  # noqa: NPY002
            kept[anyhow] = np.random.uniform(-1.0, 1.0, kept[anyhow].shape)  # noqa: NPY002
            actions = self.policy.unscale_action(kept)
        return actions, kept


class FastTD3(DeterministicLearner):
    """TD3; see the module's text for what differs."""


def build_td3(recipe: Recipe, env: VectorEnvAdapter, seed: int) -> Learner:
    """Return a learner for an environment."""
    return configured(FastTD3("MlpPolicy", env, **noisy_arguments(recipe, env, seed)), recipe)


def configured(learner: DeterministicLearner, recipe: Recipe) -> Learner:
    """Return a learner with the settings that Stable-Baselines3's own does not take."""
    learner.ways = settings = off_policy_settings(recipe)
    if settings.demonstrator is not None:
        learner.demonstrator = find_demonstrator(settings.demonstrator)
    if settings.policy_delay is not None:
        learner.policy_delay = settings.policy_delay
    return learner
