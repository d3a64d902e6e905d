"""Learning algorithms: Stable-Baselines3's, with faster updates where those were measured."""

from __future__ import annotations

from collections.abc import Callable

import gymnasium as gym

from gazelle.errors import TaskError
from gazelle.training.learners.arguments import Learner, common_arguments
from gazelle.training.learners.ddpg import build_ddpg
from gazelle.training.learners.dqn import build_dqn
from gazelle.training.learners.ppo import build_ppo
from gazelle.training.learners.sac import build_sac
from gazelle.training.learners.stable_baselines3 import build_library_learner
from gazelle.training.learners.td3 import build_td3
from gazelle.training.picture_layers import is_picture
from gazelle.training.recipes import LIBRARY_ALGORITHMS, Recipe
from gazelle.training.vecenv import VectorEnvAdapter

__all__ = ["ALGORITHMS", "Learner", "build_learner"]

ALGORITHMS: dict[str, Callable[[Recipe, VectorEnvAdapter, int], Learner]] = {
    "ppo": build_ppo,
    "dqn": build_dqn,
    "sac": build_sac,
    "td3": build_td3,
    "ddpg": build_ddpg,
}
"""Builders of the algorithms, by the names used on the command line."""


def build_learner(recipe: Recipe, env: VectorEnvAdapter, seed: int) -> Learner:
    """Return a fresh learner for an environment.

    Raises:
        TaskError: The algorithm does not know this kind of actions.
    """
    if is_picture(env.observation_space) and recipe.algo != "ppo":
        raise TaskError(f"{recipe.algo} cannot learn from pictures", hint="use ppo")
    if recipe.algo in LIBRARY_ALGORITHMS:
        return _scaled(build_library_learner(recipe, env, common_arguments(recipe, env, seed)), env)
    continuous = isinstance(env.action_space, gym.spaces.Box)
    discrete = isinstance(env.action_space, gym.spaces.Discrete)
    suits = {"ppo": continuous or discrete, "dqn": discrete}.get(recipe.algo, continuous)
    if not suits:
        fitting = "ppo or dqn" if discrete else "ppo, sac, td3 or ddpg"
        kind = type(env.action_space).__name__
        raise TaskError(f"{recipe.algo} cannot learn {kind} actions", hint=f"use {fitting}")
    return _scaled(ALGORITHMS[recipe.algo](recipe, env, seed), env)


def _scaled(learner: Learner, env: VectorEnvAdapter) -> Learner:
    """Return the learner, with the scale of its observations updated by all that is observed."""
    learner.scale = learner.policy_kwargs["features_extractor_kwargs"]["scale"]
    env.watch(learner.scale.observe)
    return learner
