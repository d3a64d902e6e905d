"""DQN, and Double DQN.

What Stable-Baselines3 computes (V. Mnih et al., "Human-level control through deep reinforcement
learning", 2015). On request the network that learns chooses the action that follows (H. van Hasselt et
al., "Deep Reinforcement Learning with Double Q-learning", 2015, arXiv 1509.06461).
"""

from __future__ import annotations

from typing import Any

import torch
from stable_baselines3 import DQN
from torch import nn

from gazelle.training.learners.arguments import Learner, off_policy_settings, replay_arguments
from gazelle.training.learners.replay import targets
from gazelle.training.recipes import OffPolicySettings, Recipe
from gazelle.training.scaling import ObservationScale
from gazelle.training.vecenv import VectorEnvAdapter


class FastDQN(DQN):  # type: ignore[misc]  # untyped base
    """DQN; see the module's text for what differs.

    Attributes:
        scale: Of observations. The memory holds them as they were, so all that is learnt from is
            scaled alike.
        ways: Learning settings beyond those of Stable-Baselines3.
    """

    scale: ObservationScale
    ways: OffPolicySettings = OffPolicySettings()

    def train(self, gradient_steps: int, batch_size: int = 100) -> None:
        """Train on a given number of minibatches."""
        self.scale.refresh()
        self.policy.set_training_mode(True)
        self._update_learning_rate(self.policy.optimizer)
        loss = torch.zeros(())
        for _ in range(gradient_steps):
            batch = self.replay_buffer.sample(batch_size)
            values = self.q_net(batch.observations).gather(1, batch.actions.long())
            loss = nn.functional.smooth_l1_loss(values, self._target(batch))
            self.policy.optimizer.zero_grad()
            torch.autograd.backward(loss)
            nn.utils.clip_grad_norm_(self.q_net.parameters(), self.max_grad_norm)
            self.policy.optimizer.step()
        self._n_updates += gradient_steps
        self.logger.record("train/n_updates", self._n_updates, exclude="tensorboard")
        self.logger.record("train/loss", loss.item())

    @torch.no_grad()
    def _target(self, batch: Any) -> torch.Tensor:
        """Return the network's target values, shape (n, 1)."""
        following = self.q_net_target(batch.next_observations)
        chooser = self.q_net(batch.next_observations) if self.ways.double_q else following
        best = chooser.argmax(dim=1, keepdim=True)
        return targets(batch, following.gather(1, best), self.gamma)


def build_dqn(recipe: Recipe, env: VectorEnvAdapter, seed: int) -> Learner:
    """Return a learner for an environment."""
    settings = off_policy_settings(recipe)
    learner = FastDQN(
        "MlpPolicy",
        env,
        exploration_fraction=settings.exploration_fraction,
        exploration_final_eps=settings.exploration_final,
        target_update_interval=settings.target_update_interval,
        **replay_arguments(recipe, env, settings, seed),
    )
    learner.ways = settings
    return learner
