"""Arguments of Stable-Baselines3's algorithms, from a recipe."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from stable_baselines3.common.noise import NormalActionNoise
from torch import nn

from gazelle.errors import TaskError
from gazelle.training.learners.her import HindsightReplayBuffer
from gazelle.training.learners.replay import MaskedReplayBuffer
from gazelle.training.picture_features import PictureFeatures
from gazelle.training.picture_layers import is_picture
from gazelle.training.recipes import OffPolicySettings, Recipe
from gazelle.training.scaling import ObservationScale, ScaledObservations
from gazelle.training.vecenv import VectorEnvAdapter

Learner = Any
"""A Stable-Baselines3 algorithm (the library gives no usable types)."""


def common_arguments(recipe: Recipe, env: VectorEnvAdapter, seed: int) -> dict[str, Any]:
    """Return the arguments that all algorithms share."""
    activation = nn.Tanh if recipe.activation == "tanh" else nn.ReLU
    sees = is_picture(env.observation_space)
    scale = ObservationScale(
        env.observation_space,
        scale=recipe.scale_observations and not sees,
        cut=recipe.cut_observations,
    )
    extractor: dict[str, Any] = {"scale": scale, "features": recipe.features}
    if not sees:
        extractor |= {"angles": recipe.angles, "bearing": recipe.bearing}
    if recipe.goal_differences and not sees:
        extractor["goals"] = _goal_places(env)
    return {
        "learning_rate": step_size(recipe),
        "gamma": recipe.gamma,
        "seed": seed,
        "device": "cpu",
        "policy_kwargs": {
            "net_arch": list(recipe.net_arch),
            "activation_fn": activation,
            "features_extractor_class": PictureFeatures if sees else ScaledObservations,
            "features_extractor_kwargs": extractor,
            "normalize_images": False,  # as the features extractor does it
        },
    }


def step_size(recipe: Recipe) -> float | Callable[[float], float]:
    """Return the learning rate: a number, or its schedule over the share of the training left."""
    rate, falling = recipe.learning_rate, 1.0 - recipe.learning_rate_hold
    if not recipe.learning_rate_decay:
        return rate
    # The last rollout of a training can go past its steps, so that less than nothing is left.
    return lambda left: rate * min(max(left, 0.0) / falling, 1.0)


def _goal_places(env: VectorEnvAdapter) -> tuple[slice, slice]:
    """Return the slices of observations with the achieved and the desired goal.

    Raises:
        TaskError: There are no goals.
    """
    goals = env.goal_replay
    if goals is None:
        raise TaskError(
            "this task has no goals, so there are no differences to observe",
            hint="leave out goal_differences",
        )
    return goals.achieved, goals.desired


def replay_arguments(
    recipe: Recipe, env: VectorEnvAdapter, settings: OffPolicySettings, seed: int
) -> dict[str, Any]:
    """Return the arguments that all algorithms with a replay memory share."""
    return common_arguments(recipe, env, seed) | {
        "buffer_size": settings.buffer_size,
        "batch_size": settings.batch_size,
        "learning_starts": settings.learning_starts,
        "train_freq": settings.train_freq,
        "gradient_steps": settings.gradient_steps,
        "tau": settings.tau,
        **replay_options(recipe, env),
    }


def noisy_arguments(recipe: Recipe, env: VectorEnvAdapter, seed: int) -> dict[str, Any]:
    """Return the arguments of algorithms that explore by noise on the action."""
    settings = off_policy_settings(recipe)
    size = env.action_space.shape[0]
    noise = NormalActionNoise(np.zeros(size), np.full(size, settings.action_noise))
    return replay_arguments(recipe, env, settings, seed) | {"action_noise": noise}


def off_policy_settings(recipe: Recipe) -> OffPolicySettings:
    """Return the settings of an algorithm with a replay memory.

    Raises:
        TaskError: The recipe has settings of another algorithm.
    """
    if not isinstance(recipe.settings, OffPolicySettings):
        raise TaskError(f"a recipe for {recipe.algo} needs OffPolicySettings")
    return recipe.settings


def replay_options(recipe: Recipe, env: VectorEnvAdapter) -> dict[str, Any]:
    """Return the replay-memory arguments of a Stable-Baselines3 algorithm.

    Raises:
        TaskError: The recipe pays in another way than the task, which does not define what that had
            been worth with other goals.
    """
    goals, steps = env.goal_replay, getattr(recipe.settings, "n_steps", 1)
    several = {"n_steps": steps, "gamma": recipe.gamma}
    if goals is None or not recipe.hindsight:
        return {"replay_buffer_class": MaskedReplayBuffer, "replay_buffer_kwargs": several}
    if recipe.goal_reward is not None:
        raise TaskError(
            "a goal_reward cannot be worked out for goals that were reached later",
            hint="set hindsight to 0, or leave out goal_reward",
        )
    return {
        "replay_buffer_class": HindsightReplayBuffer,
        "replay_buffer_kwargs": {
            "goals": goals,
            "share": recipe.hindsight,
            "redraw": recipe.hindsight_redraw,
            "reward_scale": recipe.reward_scale,
            **several,
        },
    }
