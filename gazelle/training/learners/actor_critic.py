"""Common update of the actor-critic learners `FastDDPG`, `FastTD3` and `FastSAC`."""

from __future__ import annotations

import contextlib
from collections.abc import Iterable
from typing import Any, ClassVar

import torch
from torch import nn

from gazelle.training.recipe import OffPolicySettings
from gazelle.training.scaling import ObservationScale


class CriticUpdate:
    """A learner of Stable-Baselines3 with a critic; features are computed once a minibatch.

    Attributes:
        scale: Of observations.
        ways: Learning settings beyond those of Stable-Baselines3.
        critic_weight: Of the critics' squared errors in their loss.
    """

    scale: ObservationScale
    ways: OffPolicySettings = OffPolicySettings()
    critic_weight: ClassVar[float] = 1.0
    critic: Any

    def _target(self, batch: Any) -> torch.Tensor:
        """Return the critics' target values, shape (n, 1)."""
        raise NotImplementedError

    def _improve_critic(self, features: torch.Tensor, batch: Any) -> torch.Tensor:
        """Update the critics by one step; returns their loss."""
        target = self._target(batch)
        known = torch.cat((features, batch.actions), dim=1)
        errors = [self._outputs(net, known) - target for net in self.critic.q_networks]
        loss = self.critic_weight * torch.stack([error.square().mean() for error in errors]).sum()
        self.critic.optimizer.zero_grad()
        torch.autograd.backward(loss)
        self.critic.optimizer.step()
        return loss.detach()

    def _least_value(
        self, critic: Any, features: torch.Tensor, actions: torch.Tensor
    ) -> torch.Tensor:
        """Return the least that a critic's networks say of actions, shape (n, 1)."""
        known = torch.cat((features, actions), dim=1)
        values = [self._outputs(net, known) for net in critic.q_networks]
        return torch.stack(values).amin(dim=0)

    def _outputs(self, net: nn.Sequential, inputs: torch.Tensor) -> torch.Tensor:
        return outputs_of(net, inputs, bfloat16=self.ways.bfloat16)


def follow(target: nn.Module, learnt: nn.Module, share: float) -> None:
    """Update a target towards the trained parameters, by a share of the difference."""
    torch._foreach_lerp_(list(target.parameters()), list(learnt.parameters()), share)


def outputs_of(net: nn.Sequential, inputs: torch.Tensor, *, bfloat16: bool) -> torch.Tensor:
    """Return the outputs of a network with hidden layers in bfloat16 on request.

    The last never is.
    """
    last = max(i for i, layer in enumerate(net) if isinstance(layer, nn.Linear))
    with torch.autocast("cpu", torch.bfloat16, enabled=bfloat16):
        hidden = net[:last](inputs)
    outputs: torch.Tensor = net[last:](hidden.float())
    return outputs


@contextlib.contextmanager
def frozen(parameters: Iterable[nn.Parameter]) -> Any:
    """Disable gradients of these parameters while it lasts."""
    held = list(parameters)
    for each in held:
        each.requires_grad_(False)
    try:
        yield
    finally:
        for each in held:
            each.requires_grad_(True)
