"""PPO's update of plain multi-layer perceptrons, with the chain rule written out.

Networks of some ten thousand weights and minibatches of a thousand transitions are multiplied in
half a millisecond. Recording what to differentiate, an optimiser that goes through the weights one
by one and shortening gradients likewise take several times as long. Here all weights, their
gradients and Adam's moments are one vector each for the time of an update. `ppo_update.loss_of` and
PyTorch's Adam compute the same; tests compare them.
"""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from typing import Any

import gymnasium as gym
import torch
from torch import nn

from gazelle.training.learners.ppo_update import (
    HALF_LOG_2_PI,
    Transitions,
    Weights,
    learns_features,
)

_ADAM = {"weight_decay": 0, "amsgrad": False, "maximize": False, "capturable": False}


def fits_dense_update(policy: Any) -> bool:
    """Return whether `DenseUpdate` supports a Stable-Baselines3 policy and its optimiser."""
    if not hasattr(policy, "mlp_extractor") or hasattr(policy, "lstm_actor"):
        return False
    if learns_features(policy) or getattr(policy, "use_sde", False):
        return False
    optimizer = policy.optimizer
    plain = type(optimizer) is torch.optim.Adam and len(optimizer.param_groups) == 1
    if not plain or any(optimizer.param_groups[0][key] != value for key, value in _ADAM.items()):
        return False
    if not isinstance(policy.action_space, gym.spaces.Discrete | gym.spaces.Box):
        return False
    layers = [*_layers(policy, "policy_net"), *_layers(policy, "value_net")]
    if not all(isinstance(layer, nn.Linear | nn.ReLU | nn.Tanh) for layer in layers):
        return False
    known = [id(weight) for layer in layers for weight in layer.parameters()]
    known += [id(policy.log_std)] if hasattr(policy, "log_std") else []
    return sorted(known) == sorted(id(weight) for weight in policy.parameters())


class DenseUpdate:
    """The minibatches of one update.

    Args:
        policy: One that `fits_dense_update`.
        max_grad_norm: Longer gradients are shortened to it.
        bfloat16: Hidden layers are of bfloat16, sums in them and outputs of float32.
    """

    def __init__(self, policy: Any, max_grad_norm: float, *, bfloat16: bool = False) -> None:
        self._policy = policy
        self.bfloat16 = bfloat16
        self._max_grad_norm = max_grad_norm
        self._adam = _FlatAdam(policy.optimizer)
        self._gradients = torch.zeros_like(self._adam.weights)
        self._rounded = self._adam.weights.bfloat16() if bfloat16 else None
        numbers = [id(tensor) for tensor in self._adam.tensors]
        place = dict(zip(numbers, _split(self._gradients, self._adam.tensors), strict=True))
        value = dict(zip(numbers, self._adam.views, strict=True))
        rounded = value
        if self._rounded is not None:
            rounded = dict(zip(numbers, _split(self._rounded, self._adam.tensors), strict=True))
        self._actor = _Perceptron(_layers(policy, "policy_net"), value, rounded, place)
        self._critic = _Perceptron(_layers(policy, "value_net"), value, rounded, place)
        self._discrete = isinstance(policy.action_space, gym.spaces.Discrete)
        if not self._discrete:
            self._log_std = value[id(policy.log_std)]
            self._log_std_gradient = place[id(policy.log_std)]

    @torch.no_grad()
    def learn_from(self, batch: Transitions, weights: Weights) -> torch.Tensor:
        """Update by one step; returns what the curves show of it, see `ppo_update.NAMES`.

        Args:
            batch: The minibatch.
            weights: Of the parts of the loss.
        """
        count = len(batch.returns)
        outputs = self._actor.forward(batch.features)
        judged = self._judge_choices if self._discrete else self._judge_numbers
        log_ratio, entropy, back = judged(outputs, batch, weights.ent_coef)
        ratio = log_ratio.exp()
        advantages = batch.advantages
        if count > 1:
            spread, mean = torch.std_mean(advantages)
            advantages = (advantages - mean) / (spread + 1e-8)
        within = ratio.clamp(1.0 - weights.clip_range, 1.0 + weights.clip_range)
        plain, clipped = advantages * ratio, advantages * within
        # Where the clipped one is the lesser, nothing is left to gain by moving on (NaN stays NaN).
        self._actor.backward(back(torch.where(plain > clipped, 0.0, plain) / -count))
        values = self._critic.forward(batch.features)[:, 0]
        errors = values - batch.returns
        self._critic.backward((errors * (2.0 * weights.vf_coef / count))[:, None])
        self._adam.step(self._gradients, self._max_grad_norm)
        if self._rounded is not None:
            self._rounded.copy_(self._adam.weights)
        gain, error = torch.minimum(plain, clipped).mean(), errors.square().mean()
        loss = weights.vf_coef * error - gain - weights.ent_coef * entropy
        # http://joschu.net/blog/kl-approx.html
        kl = (ratio - 1.0 - log_ratio).mean()
        return torch.stack((loss, -gain, error, -entropy, kl, (ratio != within).float().mean()))

    def finish(self) -> None:
        """Copy weights and moments back to the policy and its optimiser."""
        self._adam.write_back()

    def get_state(self) -> dict[str, Any]:
        """Return weights and moments, before they are copied back, for `set_state`."""
        return self._adam.get_state()

    def set_state(self, state: Mapping[str, Any]) -> None:
        """Restore what `get_state` returned."""
        self._adam.set_state(state)

    def _judge_choices(self, outputs: torch.Tensor, batch: Transitions, ent_coef: float) -> Any:
        """Return logarithms of ratios, mean entropy, and the gradient of the loss by outputs."""
        # Choices first: sums over a few rows are many times faster than within short rows.
        logs = outputs.t().contiguous().log_softmax(dim=0)
        chosen = batch.actions[None]
        likely = logs.exp()
        entropies = (logs * likely).sum(dim=0).neg_()

        def back(gradient: torch.Tensor) -> torch.Tensor:
            slope = (logs + entropies).mul_(ent_coef / len(entropies)).sub_(gradient)
            return slope.mul_(likely).scatter_add_(0, chosen, gradient[None]).t()

        return logs.gather(0, chosen)[0] - batch.log_probs, entropies.mean(), back

    def _judge_numbers(self, outputs: torch.Tensor, batch: Transitions, ent_coef: float) -> Any:
        """Return the same for normally distributed actions."""
        inverse = (-self._log_std).exp()
        scaled = (batch.actions - outputs) * inverse
        logs = (-0.5 * scaled.square() - self._log_std - HALF_LOG_2_PI).sum(dim=1)
        entropy = (self._log_std + 0.5 + HALF_LOG_2_PI).sum()

        def back(gradient: torch.Tensor) -> torch.Tensor:
            spread = gradient @ (scaled.square() - 1.0)
            self._log_std_gradient.copy_(spread - ent_coef)
            return gradient[:, None] * scaled * inverse

        return logs - batch.log_probs, entropy, back


class _Perceptron:
    """Layers of weights, each but the last followed by an activation, with their gradients."""

    def __init__(
        self,
        layers: list[nn.Module],
        value: dict[int, torch.Tensor],
        rounded: dict[int, torch.Tensor],
        gradient: dict[int, torch.Tensor],
    ) -> None:
        linear = [layer for layer in layers if isinstance(layer, nn.Linear)]
        self._weights = [(rounded[id(at.weight)], rounded[id(at.bias)]) for at in linear]
        last = linear[-1]
        self._weights[-1] = value[id(last.weight)], value[id(last.bias)]
        self._gradients = [(gradient[id(at.weight)], gradient[id(at.bias)]) for at in linear]
        self._relu = any(isinstance(layer, nn.ReLU) for layer in layers)
        self._given: list[torch.Tensor] = []

    def forward(self, x: torch.Tensor) -> torch.Tensor:
        """Return the output of the last layer for rows of features."""
        self._given = [x]
        for weight, bias in self._weights[:-1]:
            x = nn.functional.linear(x, weight, bias)
            x = x.relu_() if self._relu else x.tanh_()
            self._given.append(x)
        self._given[-1] = x.float()
        return nn.functional.linear(self._given[-1], *self._weights[-1])

    def backward(self, slope: torch.Tensor) -> None:
        """Compute gradients from that of the loss by the outputs of the last `forward`."""
        for level in reversed(range(len(self._weights))):
            given = self._given[level]
            slope = slope.to(given.dtype)
            weight_gradient, bias_gradient = self._gradients[level]
            weight_gradient.copy_(slope.t() @ given)
            torch.sum(slope, 0, dtype=bias_gradient.dtype, out=bias_gradient)
            if level:
                slope = slope @ self._weights[level][0]
                if self._relu:
                    slope = torch.ops.aten.threshold_backward(slope, given, 0)
                else:
                    slope = torch.ops.aten.tanh_backward(slope, given)


class _FlatAdam:
    """PyTorch's Adam on all weights in a row (Kingma and Ba 2015, arXiv 1412.6980)."""

    def __init__(self, optimizer: torch.optim.Adam) -> None:
        self._optimizer = optimizer
        group = optimizer.param_groups[0]
        self.tensors: list[torch.Tensor] = group["params"]
        self._rate, self._betas, self._eps = float(group["lr"]), group["betas"], group["eps"]
        states = [optimizer.state[tensor] for tensor in self.tensors]
        self.weights = _joined(self.tensors)
        self.views = _split(self.weights, self.tensors)
        zeros = [torch.zeros_like(tensor) for tensor in self.tensors]
        self._first, self._second = (
            _joined([state.get(name, zero) for state, zero in zip(states, zeros, strict=True)])
            for name in ("exp_avg", "exp_avg_sq")
        )
        self._count = int(states[0]["step"]) if states[0] else 0

    def step(self, gradients: torch.Tensor, longest: float) -> None:
        """Move the weights, with gradients shortened as ``clip_grad_norm_`` does."""
        length = torch.linalg.vector_norm(gradients)
        # An infinite one makes weights NaN, which is reported, where it would stop all learning.
        gradients.mul_((longest / (length + 1e-6)).clamp_(max=1.0) + 0.0 * length)
        self._count += 1
        first, second = self._betas
        self._first.lerp_(gradients, 1.0 - first)
        self._second.mul_(second).addcmul_(gradients, gradients, value=1.0 - second)
        size = self._second.sqrt().div_((1.0 - second**self._count) ** 0.5).add_(self._eps)
        self.weights.addcdiv_(self._first, size, value=-self._rate / (1.0 - first**self._count))

    def get_state(self) -> dict[str, Any]:
        """Return weights, moments and the number of steps."""
        flat = {name: getattr(self, f"_{name}").numpy() for name in ("first", "second")}
        return {**flat, "weights": self.weights.numpy(), "count": self._count}

    def set_state(self, state: Mapping[str, Any]) -> None:
        """Restore what `get_state` returned."""
        for flat, name in ((self._first, "first"), (self._second, "second")):
            flat.copy_(torch.as_tensor(state[name]))
        self.weights.copy_(torch.as_tensor(state["weights"]))
        self._count = int(state["count"])

    def write_back(self) -> None:
        """Write all into the optimiser and its tensors."""
        parts = (_split(flat, self.tensors) for flat in (self._first, self._second))
        for tensor, weight, first, second in zip(self.tensors, self.views, *parts, strict=True):
            tensor.data.copy_(weight)
            state = self._optimizer.state[tensor]
            if not state:
                state |= {"step": torch.tensor(0.0), "exp_avg": first, "exp_avg_sq": second}
            state["step"].fill_(float(self._count))
            state["exp_avg"], state["exp_avg_sq"] = first.clone(), second.clone()


def _layers(policy: Any, name: str) -> list[nn.Module]:
    """Return the layers of one of the two networks in order, with its head."""
    head = policy.action_net if name == "policy_net" else policy.value_net
    return [*getattr(policy.mlp_extractor, name), head]


def _joined(tensors: Sequence[torch.Tensor]) -> torch.Tensor:
    """Return all numbers of some tensors in a row, copied, shape (n,)."""
    return torch.cat([tensor.detach().reshape(-1) for tensor in tensors])


def _split(flat: torch.Tensor, like: Sequence[torch.Tensor]) -> list[torch.Tensor]:
    """Return views of a row, of the shapes of other tensors one after the other."""
    ends = list(itertools.accumulate(tensor.numel() for tensor in like))
    starts = [0, *ends[:-1]]
    return [
        flat[start:end].view(tensor.shape)
        for start, end, tensor in zip(starts, ends, like, strict=True)
    ]
