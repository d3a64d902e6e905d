"""From a Stable-Baselines3 policy in torch to an `Actor` in numpy."""

from __future__ import annotations

from typing import Any

import gymnasium as gym
import numpy as np
import torch
from torch import nn

from gazelle.array_types import Floats32
from gazelle.errors import TaskError
from gazelle.training.actor import Actor, Head
from gazelle.training.memory_layers import MemoryLayers
from gazelle.training.picture_features import PictureFeatures


def export_actor(policy: Any) -> Actor:
    """Copy the acting part of a policy into numpy arrays.

    The scaling of observations, as it is now, is folded into the first layer.

    Args:
        policy: The ``policy`` of a Stable-Baselines3 PPO, DQN, SAC, TD3 or DDPG
            with the features extractor `ScaledObservations` or `PictureFeatures`, or of
            sb3-contrib's RecurrentPPO.

    Raises:
        TaskError: The policy is not a multi-layer perceptron.
    """
    space = policy.action_space
    head, extractor, modules = _parts(policy)
    weights, biases = _linear_layers(modules)
    sees = isinstance(extractor, PictureFeatures)
    if hasattr(policy, "quantile_net"):
        _take_means(weights, biases, policy.quantile_net.n_quantiles)
    memory = _memory(policy.lstm_actor) if hasattr(policy, "lstm_actor") else None
    if memory is not None and not sees:
        first, more = _unscaled(memory.inputs[0], extractor)
        memory = MemoryLayers(
            (first, *memory.inputs[1:]),
            memory.hidden,
            (memory.biases[0] + more, *memory.biases[1:]),
        )
    elif not sees:
        weights[0], more = _unscaled(weights[0], extractor)
        biases[0] = biases[0] + more
    relu = any(isinstance(module, nn.ReLU) for module in modules)
    continuous = isinstance(space, gym.spaces.Box)
    return Actor(
        weights=tuple(weights),
        biases=tuple(biases),
        activation="relu" if relu else "tanh",
        head=head,
        log_std=_numpy(policy.log_std) if head == "gaussian" else None,
        low=space.low.astype(np.float32) if continuous else None,
        high=space.high.astype(np.float32) if continuous else None,
        first_action=int(space.start) if isinstance(space, gym.spaces.Discrete) else 0,
        limits=_numpy(extractor.limits) if not sees and extractor.cuts else None,
        features=None if sees else extractor.features,
        pictures=extractor.exported() if sees else None,
        memory=memory,
    )


def _unscaled(weight: Floats32, extractor: Any) -> tuple[Floats32, Floats32]:
    """Return the first layer for observations as they are: its weights, and what its biases gain.

    Scaling and the differences of goals are linear, so they are part of the layer.
    """
    gain, offset = _numpy(extractor.gain), _numpy(extractor.offset)
    entries = len(gain)
    added = offset @ weight[:entries]
    weight[:entries] *= gain[:, None]
    if extractor.goals is not None:
        achieved, desired = extractor.goals
        count = desired.stop - desired.start
        differences = weight[-count:] * gain[desired, None]
        weight = weight[:-count].copy()
        weight[desired] += differences
        weight[achieved] -= differences
    return weight, added


def _parts(policy: Any) -> tuple[Head, Any, list[nn.Module]]:
    """Return the head, the features extractor and the layers in order."""
    if hasattr(policy, "mlp_extractor"):
        head: Head = "categorical"
        if isinstance(policy.action_space, gym.spaces.Box):
            head = "gaussian"
        layers = [*policy.mlp_extractor.policy_net, policy.action_net]
        return head, policy.pi_features_extractor, layers
    if hasattr(policy, "quantile_net"):
        net = policy.quantile_net
        return "greedy", net.features_extractor, list(net.quantile_net)
    if hasattr(policy, "q_net"):
        return "greedy", policy.q_net.features_extractor, list(policy.q_net.q_net)
    if hasattr(policy.actor, "latent_pi"):
        layers = [*policy.actor.latent_pi, policy.actor.mu]
        return "squashed", policy.actor.features_extractor, layers
    return "squashed", policy.actor.features_extractor, list(policy.actor.mu)


def _memory(lstm: nn.LSTM) -> MemoryLayers:
    """Return the layers of a policy that remembers."""
    numbers = range(lstm.num_layers)
    return MemoryLayers(
        tuple(_numpy(getattr(lstm, f"weight_ih_l{number}").T) for number in numbers),
        tuple(_numpy(getattr(lstm, f"weight_hh_l{number}").T) for number in numbers),
        tuple(
            _numpy(getattr(lstm, f"bias_ih_l{number}") + getattr(lstm, f"bias_hh_l{number}"))
            for number in numbers
        ),
    )


def _linear_layers(modules: list[nn.Module]) -> tuple[list[Floats32], list[Floats32]]:
    linear = [module for module in modules if isinstance(module, nn.Linear)]
    other = [module for module in modules if not isinstance(module, nn.Linear | nn.Tanh | nn.ReLU)]
    if other or not linear:
        raise TaskError(f"cannot copy a policy with a {type((other or modules)[0]).__name__} layer")
    weights = [np.ascontiguousarray(_numpy(module.weight).T) for module in linear]
    return weights, [_numpy(module.bias) for module in linear]


def _take_means(weights: list[Floats32], biases: list[Floats32], quantiles: int) -> None:
    """Replace quantiles of the values of actions by their means, which are linear."""
    shape = (len(weights[-1]), quantiles, -1)
    weights[-1] = weights[-1].reshape(shape).mean(axis=1, dtype=np.float64).astype(np.float32)
    biases[-1] = biases[-1].reshape(quantiles, -1).mean(axis=0)


def _numpy(tensor: torch.Tensor) -> Floats32:
    array: Floats32 = tensor.detach().cpu().numpy().astype(np.float32, copy=True)
    return array
