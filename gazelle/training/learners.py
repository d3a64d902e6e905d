"""Build a learner from a recipe: one function an algorithm, in a table."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import gymnasium as gym
import numpy as np
from stable_baselines3 import DQN
from stable_baselines3.common.noise import NormalActionNoise
from torch import nn

from gazelle.errors import TaskError
from gazelle.training.demonstrations import find_demonstrator
from gazelle.training.deterministic import FastDDPG, FastTD3
from gazelle.training.library import build_library_learner
from gazelle.training.memories import replay_options
from gazelle.training.picture_features import PictureFeatures
from gazelle.training.picture_layers import is_picture
from gazelle.training.ppo import FastPPO
from gazelle.training.recipes import LIBRARY_ALGORITHMS, OffPolicySettings, PPOSettings, Recipe
from gazelle.training.scaling import ObservationScale, ScaledObservations
from gazelle.training.soft import FastSAC
from gazelle.training.vecenv import VectorEnvAdapter

Learner = Any
"""A Stable-Baselines3 algorithm (the library gives no usable types)."""


def build_learner(recipe: Recipe, env: VectorEnvAdapter, seed: int) -> Learner:
    """A fresh learner for an environment.

    Raises:
        TaskError: The algorithm does not know this kind of actions.
    """
    if is_picture(env.observation_space) and recipe.algo != "ppo":
        raise TaskError(f"{recipe.algo} cannot learn from pictures", hint="use ppo")
    if recipe.algo in LIBRARY_ALGORITHMS:
        return _scaled(build_library_learner(recipe, env, _common(recipe, env, seed)), env)
    continuous = isinstance(env.action_space, gym.spaces.Box)
    discrete = isinstance(env.action_space, gym.spaces.Discrete)
    suits = {"ppo": continuous or discrete, "dqn": discrete}.get(recipe.algo, continuous)
    if not suits:
        fitting = "ppo or dqn" if discrete else "ppo, sac, td3 or ddpg"
        kind = type(env.action_space).__name__
        raise TaskError(f"{recipe.algo} cannot learn {kind} actions", hint=f"use {fitting}")
    return _scaled(ALGORITHMS[recipe.algo](recipe, env, seed), env)


def _scaled(learner: Learner, env: VectorEnvAdapter) -> Learner:
    """The learner, with the scale of its observations told of all that is observed."""
    learner.scale = learner.policy_kwargs["features_extractor_kwargs"]["scale"]
    env.watch(learner.scale.observe)
    return learner


class _Rescaled:
    """An algorithm with a replay memory that scales observations anew before it learns.

    The memory holds them as they were, so all that is learnt from is scaled alike.
    """

    scale: ObservationScale

    def train(self, *arguments: Any, **options: Any) -> None:
        self.scale.refresh()
        super().train(*arguments, **options)  # type: ignore[misc]  # of the algorithm


class _DQN(_Rescaled, DQN):  # type: ignore[misc]  # untyped base
    pass


def _build_ppo(recipe: Recipe, env: VectorEnvAdapter, seed: int) -> Learner:
    settings = recipe.settings
    if not isinstance(settings, PPOSettings):
        raise TaskError("a recipe for ppo needs PPOSettings")
    common = _common(recipe, env, seed)
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
    return learner


def _build_dqn(recipe: Recipe, env: VectorEnvAdapter, seed: int) -> Learner:
    settings = _off_policy(recipe)
    return _DQN(
        "MlpPolicy",
        env,
        exploration_fraction=settings.exploration_fraction,
        exploration_final_eps=settings.exploration_final,
        target_update_interval=settings.target_update_interval,
        **_replaying(recipe, env, settings, seed),
    )


def _build_sac(recipe: Recipe, env: VectorEnvAdapter, seed: int) -> Learner:
    settings = _off_policy(recipe)
    learner = FastSAC(
        "MlpPolicy",
        env,
        ent_coef=f"auto_{settings.initial_entropy_weight}",
        **_replaying(recipe, env, settings, seed),
    )
    learner.ways = settings
    return learner


def _build_td3(recipe: Recipe, env: VectorEnvAdapter, seed: int) -> Learner:
    return _settled(FastTD3("MlpPolicy", env, **_noisy(recipe, env, seed)), recipe)


def _build_ddpg(recipe: Recipe, env: VectorEnvAdapter, seed: int) -> Learner:
    return _settled(FastDDPG("MlpPolicy", env, **_noisy(recipe, env, seed)), recipe)


def _settled(learner: FastTD3 | FastDDPG, recipe: Recipe) -> Learner:
    """The learner, with what Stable-Baselines3's own does not take."""
    learner.ways = settings = _off_policy(recipe)
    if settings.demonstrator is not None:
        learner.demonstrator = find_demonstrator(settings.demonstrator)
    if settings.policy_delay is not None:
        learner.policy_delay = settings.policy_delay
    return learner


ALGORITHMS: dict[str, Callable[[Recipe, VectorEnvAdapter, int], Learner]] = {
    "ppo": _build_ppo,
    "dqn": _build_dqn,
    "sac": _build_sac,
    "td3": _build_td3,
    "ddpg": _build_ddpg,
}
"""The algorithms, by the name used on the command line."""


def _common(recipe: Recipe, env: VectorEnvAdapter, seed: int) -> dict[str, Any]:
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
        "learning_rate": _step_size(recipe),
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


def _step_size(recipe: Recipe) -> float | Callable[[float], float]:
    """Of the optimiser: a number, or what gives it for the share of the training that is left."""
    rate, falling = recipe.learning_rate, 1.0 - recipe.learning_rate_hold
    if not recipe.learning_rate_decay:
        return rate
    return lambda left: rate * min(left / falling, 1.0)


def _goal_places(env: VectorEnvAdapter) -> tuple[slice, slice]:
    """Return the slices of observations with the achieved and the desired goal.

    Raises:
        TaskError: There are no goals.
    """
    goals = env.goal_replay
    if goals is None:
        raise TaskError(
            "this task has no goals, of which a network could be told the differences",
            hint="leave out goal_differences",
        )
    return goals.achieved, goals.desired


def _replaying(
    recipe: Recipe, env: VectorEnvAdapter, settings: OffPolicySettings, seed: int
) -> dict[str, Any]:
    """Return the arguments that all algorithms with a replay memory share."""
    return _common(recipe, env, seed) | {
        "buffer_size": settings.buffer_size,
        "batch_size": settings.batch_size,
        "learning_starts": settings.learning_starts,
        "train_freq": settings.train_freq,
        "gradient_steps": settings.gradient_steps,
        "tau": settings.tau,
        **replay_options(recipe, env),
    }


def _noisy(recipe: Recipe, env: VectorEnvAdapter, seed: int) -> dict[str, Any]:
    """Return the arguments of algorithms that explore by noise on the action."""
    settings = _off_policy(recipe)
    size = env.action_space.shape[0]
    noise = NormalActionNoise(np.zeros(size), np.full(size, settings.action_noise))
    return _replaying(recipe, env, settings, seed) | {"action_noise": noise}


def _off_policy(recipe: Recipe) -> OffPolicySettings:
    if not isinstance(recipe.settings, OffPolicySettings):
        raise TaskError(f"a recipe for {recipe.algo} needs OffPolicySettings")
    return recipe.settings
