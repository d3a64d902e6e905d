"""PPO's update on whole tensors (Schulman et al. 2017, arXiv 1707.06347).

What Stable-Baselines3 computes, without an object for each minibatch: observations are made
features once a rollout, and the networks are called layer by layer.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import gymnasium as gym
import numpy as np
import torch

HALF_LOG_2_PI = 0.5 * float(np.log(2.0 * np.pi))
"""Of the logarithm of a normal density."""


@dataclass(frozen=True, slots=True)
class Transitions:
    """Transitions of a rollout, n of them.

    Attributes:
        features: Inputs of the networks, shape (n, features); images as they are,
            as the layers that look at them learn, too.
        actions: Numbers of choices, int64 of shape (n,), or float32 of shape (n, actions).
        log_probs: Of the actions when they were drawn, shape (n,).
        advantages: Shape (n,).
        returns: Shape (n,).
    """

    features: torch.Tensor
    actions: torch.Tensor
    log_probs: torch.Tensor
    advantages: torch.Tensor
    returns: torch.Tensor

    def pick(self, rows: torch.Tensor | slice) -> Transitions:
        """Return some of them, in this order; those of a slice are not copied."""
        return Transitions(
            self.features[rows],
            self.actions[rows],
            self.log_probs[rows],
            self.advantages[rows],
            self.returns[rows],
        )

    def minibatches(self, order: torch.Tensor, size: int) -> Iterator[Transitions]:
        """Yield all of them in this order, a given number at a time."""
        ordered = self.pick(order)
        for start in range(0, len(order), size):
            yield ordered.pick(slice(start, start + size))


@dataclass(frozen=True, slots=True)
class Weights:
    """Weights of the parts of the loss; see `PPOSettings`."""

    clip_range: float
    ent_coef: float
    vf_coef: float


NAMES = (
    "loss",
    "policy_gradient_loss",
    "value_loss",
    "entropy_loss",
    "approx_kl",
    "clip_fraction",
)
"""Names of the values of `loss_of`, in order."""


def loss_of(policy: Any, batch: Transitions, weights: Weights) -> tuple[torch.Tensor, torch.Tensor]:
    """Return the loss of a minibatch, and what the curves show of it, see `NAMES`, shape (6,).

    Args:
        policy: A Stable-Baselines3 ``ActorCriticPolicy`` with discrete or normal actions.
        batch: The minibatch.
        weights: Of the parts of the loss.
    """
    nets = policy.mlp_extractor
    features = batch.features
    if learns_features(policy):
        features = policy.features_extractor(features)
    outputs = policy.action_net(nets.policy_net(features))
    log_probs, entropy = _judged(policy, outputs, batch.actions)
    log_ratio = log_probs - batch.log_probs
    ratio = log_ratio.exp()
    advantages = batch.advantages
    if len(advantages) > 1:
        advantages = (advantages - advantages.mean()) / (advantages.std() + 1e-8)
    within = ratio.clamp(1.0 - weights.clip_range, 1.0 + weights.clip_range)
    gain = torch.min(advantages * ratio, advantages * within).mean()
    values = policy.value_net(nets.value_net(features))[:, 0]
    error = (values - batch.returns).square().mean()
    loss = weights.vf_coef * error - gain - weights.ent_coef * entropy
    with torch.no_grad():
        # http://joschu.net/blog/kl-approx.html
        kl = (ratio - 1.0 - log_ratio).mean()
        clipped = (ratio != within).float().mean()
        figures = torch.stack((loss, -gain, error, -entropy, kl, clipped))
    return loss, figures


def learns_features(policy: Any) -> bool:
    """Return whether the policy's feature extractor has weights of its own."""
    return next(policy.features_extractor.parameters(), None) is not None


def _judged(
    policy: Any, outputs: torch.Tensor, actions: torch.Tensor
) -> tuple[torch.Tensor, torch.Tensor]:
    """Return log-probabilities of actions, shape (n,), and the mean entropy."""
    if isinstance(policy.action_space, gym.spaces.Discrete):
        logs = outputs.log_softmax(dim=1)
        entropy = -(logs * logs.exp()).sum(dim=1).mean()
        return logs.gather(1, actions[:, None])[:, 0], entropy
    log_std = policy.log_std
    scaled = (actions - outputs) * (-log_std).exp()
    logs = (-0.5 * scaled.square() - log_std - HALF_LOG_2_PI).sum(dim=1)
    return logs, (log_std + 0.5 + HALF_LOG_2_PI).sum()
