"""Further algorithms of Stable-Baselines3 and sb3-contrib, by name, with their own arguments."""

from __future__ import annotations

import importlib
import inspect
from typing import Any

import gymnasium as gym
from stable_baselines3.common.off_policy_algorithm import OffPolicyAlgorithm

from gazelle.errors import MissingExtraError, TaskError, did_you_mean
from gazelle.training.learners.arguments import replay_options
from gazelle.training.overrides import supporting_algorithms
from gazelle.training.recipes import LIBRARY_ALGORITHMS, LibrarySettings, Recipe
from gazelle.training.supported_values import unsupported_error
from gazelle.training.vecenv import VectorEnvAdapter

_POLICIES = {"recurrent_ppo": "MlpLstmPolicy"}
_DISCRETE_ONLY = {"qrdqn"}
_CONTINUOUS_ONLY = {"tqc"}
_GIVEN = {"policy", "env", "replay_buffer_class", "replay_buffer_kwargs"}


def build_library_learner(recipe: Recipe, env: VectorEnvAdapter, common: dict[str, Any]) -> Any:
    """Return a learner that Gazelle has no builder of its own for.

    Args:
        recipe: With `LibrarySettings`.
        env: The environment.
        common: Settings of all algorithms.

    Raises:
        MissingExtraError: sb3-contrib is not installed.
        TaskError: The algorithm does not take a setting or this kind of actions.
    """
    if not isinstance(recipe.settings, LibrarySettings):
        raise TaskError(f"a recipe for {recipe.algo} needs LibrarySettings")
    discrete = isinstance(env.action_space, gym.spaces.Discrete)
    if recipe.algo in (_CONTINUOUS_ONLY if discrete else _DISCRETE_ONLY):
        kind = type(env.action_space).__name__
        fitting = "qrdqn, a2c or trpo" if discrete else "tqc, a2c or trpo"
        raise TaskError(f"{recipe.algo} cannot learn {kind} actions", hint=f"use {fitting}")
    found = _find(recipe.algo)
    memory = replay_options(recipe, env) if issubclass(found, OffPolicyAlgorithm) else {}
    _check_options(recipe.algo, recipe.settings, found)
    options = common | dict(recipe.settings.options) | memory
    return _rescaling(found)(_POLICIES.get(recipe.algo, "MlpPolicy"), env, **options)


def _check_options(algo: str, settings: LibrarySettings, kind: type[Any]) -> None:
    """Check that options are known to the class and not set elsewhere."""
    taken = set(inspect.signature(kind).parameters) - _GIVEN
    for name in settings.options:
        if name in _GIVEN:
            raise TaskError(f"{algo} is given its '{name}'", hint="leave it out")
        if name not in taken:
            if supporting := supporting_algorithms(name):
                raise unsupported_error(algo, name, supporting)
            hint = did_you_mean(name, taken)
            raise TaskError(f"{algo} does not take '{name}'", hint=hint)


def _find(name: str) -> type[Any]:
    package, kind = LIBRARY_ALGORITHMS[name]
    try:
        found: type[Any] = getattr(importlib.import_module(package), kind)
    except ModuleNotFoundError as error:
        if error.name != package:
            raise
        raise MissingExtraError(package.replace("_", "-"), "train") from error
    return found


def _rescaling(kind: type[Any]) -> type[Any]:
    """Return the algorithm, extended to rescale observations after each update."""

    class Rescaling(kind):  # type: ignore[misc]  # of a class that is looked up
        def train(self, *arguments: Any, **options: Any) -> None:
            super().train(*arguments, **options)
            self.scale.refresh()

    Rescaling.__name__ = kind.__name__
    return Rescaling
