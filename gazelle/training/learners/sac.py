"""SAC with an update that costs a processor less.

What Stable-Baselines3 computes (T. Haarnoja et al., "Soft Actor-Critic Algorithms and Applications",
2018, arXiv 1812.05905): observations are made features once a minibatch, the critics are evaluated for
no gradients while the actor learns, and the targets follow in one call. Besides, the actor may learn
from fewer minibatches than the critics.
"""

from __future__ import annotations

import math
from typing import Any, ClassVar

import torch
from stable_baselines3 import SAC
from torch import nn

from gazelle.training.learners.actor_critic import CriticUpdate, follow, frozen
from gazelle.training.learners.arguments import Learner, off_policy_settings, replay_arguments
from gazelle.training.learners.ppo_update import HALF_LOG_2_PI
from gazelle.training.learners.replay import targets
from gazelle.training.recipes import Recipe
from gazelle.training.vecenv import VectorEnvAdapter

_LOG_STD = -20.0, 2.0  # bounds of the logarithm of an action's deviation


class FastSAC(CriticUpdate, SAC):  # type: ignore[misc]  # untyped base
    """SAC; see the module's text for what differs."""

    critic_weight: ClassVar[float] = 0.5

    def train(self, gradient_steps: int, batch_size: int = 64) -> None:
        """Train on a given number of minibatches."""
        # The memory holds observations as they were, so all that is learnt from is scaled alike.
        self.scale.refresh()
        self.policy.set_training_mode(True)
        optimizers = [self.actor.optimizer, self.critic.optimizer, self.ent_coef_optimizer]
        self._update_learning_rate(optimizers)
        critic_loss = actor_loss = torch.zeros(())
        for _ in range(gradient_steps):
            self._n_updates += 1
            batch = self.replay_buffer.sample(batch_size)
            features = self.actor.features_extractor(batch.observations)
            due = self._n_updates % (self.ways.policy_delay or 1) == 0
            drawn = self._drawn(features) if due else None
            critic_loss = self._improve_critic(features, batch)
            if drawn is not None:
                actor_loss = self._improve_actor(features, *drawn)
            self._follow()
        self.logger.record("train/n_updates", self._n_updates, exclude="tensorboard")
        self.logger.record("train/ent_coef", self.log_ent_coef.exp().item())
        self.logger.record("train/actor_loss", actor_loss.item())
        self.logger.record("train/critic_loss", critic_loss.item())

    @torch.no_grad()
    def _target(self, batch: Any) -> torch.Tensor:
        """Return the critics' target values, shape (n, 1)."""
        following = self.actor.features_extractor(batch.next_observations)
        actions, logs = self._drawn(following)
        least = self._least_value(self.critic_target, following, actions)
        return targets(batch, least - self.log_ent_coef.exp() * logs, self.gamma)

    def _improve_actor(
        self, features: torch.Tensor, actions: torch.Tensor, logs: torch.Tensor
    ) -> torch.Tensor:
        """Update the actor and the entropy coefficient by one step; returns the actor's loss.

        Args:
            features: Of the minibatch, shape (n, entries).
            actions: Drawn for them, see `_drawn`.
            logs: Likewise.
        """
        price = self.log_ent_coef.detach().exp()
        with frozen(self.critic.parameters()):
            values = self._least_value(self.critic, features, actions)
        loss: torch.Tensor = (price * logs - values).mean()
        self.actor.optimizer.zero_grad()
        torch.autograd.backward(loss)
        self.actor.optimizer.step()
        # The gradient by the logarithm of the price is how far the entropy is above its target.
        self.log_ent_coef.grad = -(logs.detach().mean() + self.target_entropy).reshape(1)
        self.ent_coef_optimizer.step()
        return loss.detach()

    def _drawn(self, features: torch.Tensor) -> tuple[torch.Tensor, torch.Tensor]:
        """Return actions, shape (n, actions), and logarithms of their densities, shape (n, 1)."""
        latent = self._outputs(self.actor.latent_pi, features)
        mean = self.actor.mu(latent)
        log_std = self.actor.log_std(latent).clamp(*_LOG_STD)
        noise = torch.randn_like(mean)
        raw = mean + log_std.exp() * noise
        # Of the stretched tangent: log(1 - tanh(x)^2), without loss of digits where x is large.
        flat = 2.0 * (math.log(2.0) - raw - nn.functional.softplus(-2.0 * raw))
        logs = -0.5 * noise.square() - log_std - HALF_LOG_2_PI - flat
        return raw.tanh(), logs.sum(dim=1, keepdim=True)

    @torch.no_grad()
    def _follow(self) -> None:
        """Update the target networks."""
        follow(self.critic_target, self.critic, self.tau)


def build_sac(recipe: Recipe, env: VectorEnvAdapter, seed: int) -> Learner:
    """Return a learner for an environment."""
    settings = off_policy_settings(recipe)
    learner = FastSAC(
        "MlpPolicy",
        env,
        ent_coef=f"auto_{settings.initial_entropy_weight}",
        **replay_arguments(recipe, env, settings, seed),
    )
    learner.ways = settings
    return learner
