"""Policies and noise from parameters."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from gazelle.drop_in.frobs_rl.common.connection import parameter
from gazelle.drop_in.frobs_rl.models.library import stable_baselines3, torch
from gazelle.drop_in.frobs_rl.wrappers.modern import modern
from gazelle.errors import TaskError, did_you_mean
from gazelle_ros.compat import rospy

_ACTIVATIONS = {"relu": "ReLU", "tanh": "Tanh", "elu": "ELU", "selu": "SELU"}
_EXTRACTORS = ("FlattenExtractor", "BaseFeaturesExtractor", "CombinedExtractor")
_OPTIMIZERS = ("Adam", "Adadelta", "Adagrad", "RMSprop", "SGD")


def get_policy_kwargs(ns: str = "/") -> dict[str, Any] | None:
    """Return ``policy_kwargs`` for Stable-Baselines3; None unless ``use_custom_policy`` is set.

    Raises:
        TaskError: A parameter names what is not there.
    """
    if not rospy.get_param(parameter(ns, "model_params/use_custom_policy"), False):
        return None
    settings: Mapping[str, Any] = rospy.get_param(parameter(ns, "model_params/policy_params"))
    activation = _chosen("activation_fn", str(settings["activation_fn"]).lower(), _ACTIVATIONS)
    extractor = _chosen(
        "features_extractor_class", settings["features_extractor_class"], _EXTRACTORS
    )
    optimizer = _chosen("optimizer_class", settings["optimizer_class"], _OPTIMIZERS)
    return {
        "activation_fn": getattr(torch("nn"), _ACTIVATIONS[activation]),
        "features_extractor_class": getattr(stable_baselines3("common.torch_layers"), extractor),
        "optimizer_class": getattr(torch("optim"), optimizer),
        "net_arch": list(settings["net_arch"]),
    }


def get_action_noise(action_space_shape: int | tuple[int, ...], ns: str = "/") -> Any:
    """Return Gaussian noise for actions of a shape; None unless ``use_action_noise`` is set."""
    if not rospy.get_param(parameter(ns, "model_params/use_action_noise"), False):
        return None
    settings: Mapping[str, float] = rospy.get_param(parameter(ns, "model_params/action_noise"))
    one = np.ones(action_space_shape)
    return stable_baselines3("common.noise").NormalActionNoise(
        mean=settings["mean"] * one, sigma=settings["sigma"] * one
    )


def check_env(env: Any) -> None:
    """Check an environment as Stable-Baselines3 does.

    Raises:
        AssertionError: It does not keep to Gymnasium's interface.
    """
    stable_baselines3("common.env_checker").check_env(modern(env))


def test_env(env: Any) -> bool:
    """Check an environment; returns True."""
    check_env(env)
    return True


def _chosen(name: str, value: Any, known: Mapping[str, str] | tuple[str, ...]) -> str:
    if value not in known:
        raise TaskError(f"{name} is no '{value}'", hint=did_you_mean(str(value), known))
    return str(value)
