"""Change single values of a recipe by name, wherever in it they stand."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Any

from gazelle.errors import TaskError, did_you_mean
from gazelle.training.bearing import bearing_of
from gazelle.training.goal_reward import GoalReward
from gazelle.training.recipes import (
    ALGORITHM_NAMES,
    LibrarySettings,
    OffPolicySettings,
    PPOSettings,
    Recipe,
)
from gazelle.training.supported_values import PARTIAL_SUPPORT, supports, unsupported_error

_OWN = {"algo", "settings", "training_options", "evaluation_options"}
_REPLAYING = tuple(name for name in ALGORITHM_NAMES if name != "ppo")


def with_values(recipe: Recipe, values: Mapping[str, Any]) -> Recipe:
    """Return a recipe in which some values are others.

    Args:
        recipe: Recipe without them.
        values: By name: of a field of `Recipe` (``learning_rate``, ``net_arch`` ...), of its
            settings (``batch_size`` ...), or of its goal reward, as ``goal_reward.collision``.
            For an algorithm with `LibrarySettings`, any argument of its class.

    Raises:
        TaskError: There is no such value, the algorithm does not support it, or it is invalid.
    """
    fields = {each.name for each in dataclasses.fields(Recipe)} - _OWN
    library = isinstance(recipe.settings, LibrarySettings)
    inner = {each.name for each in dataclasses.fields(recipe.settings)}
    rewards = {f"goal_reward.{each.name}" for each in dataclasses.fields(GoalReward)}
    outer: dict[str, Any] = {}
    settings: dict[str, Any] = {}
    reward: dict[str, Any] = {}
    for name, value in values.items():
        if name in fields | inner and not supports(recipe.algo, name):
            raise unsupported_error(recipe.algo, name, PARTIAL_SUPPORT[name])
        if name in fields:
            outer[name] = _typed(name, value)
        elif name in rewards:
            reward[name.partition(".")[2]] = value
        elif library or name in inner:
            settings[name] = value
        else:
            if supporting := supporting_algorithms(name):
                raise unsupported_error(recipe.algo, name, supporting)
            hint = did_you_mean(name, fields | inner | rewards)
            raise TaskError(f"a recipe for {recipe.algo} has no '{name}'", hint=hint)
    if settings:
        outer["settings"] = _changed(recipe.settings, settings)
    if reward:
        outer["goal_reward"] = dataclasses.replace(recipe.goal_reward or GoalReward(), **reward)
    try:
        return dataclasses.replace(recipe, **outer)
    except TypeError as error:
        raise TaskError(f"a value of the recipe is invalid: {error}") from error


def supporting_algorithms(name: str) -> tuple[str, ...]:
    """Return the algorithms that support one of these.

    They have `PPOSettings` or `OffPolicySettings`.
    """
    kinds = {"ppo": PPOSettings} | dict.fromkeys(_REPLAYING, OffPolicySettings)
    having = [
        algo
        for algo, kind in kinds.items()
        if name in {each.name for each in dataclasses.fields(kind)}
    ]
    return tuple(algo for algo in having if supports(algo, name))


def _changed(settings: Any, values: dict[str, Any]) -> Any:
    if isinstance(settings, LibrarySettings):
        return LibrarySettings(options={**settings.options, **values})
    return dataclasses.replace(settings, **values)


def _typed(name: str, value: Any) -> Any:
    """Return a value of a recipe, from what JSON has for it."""
    if name == "bearing" and value is not None:
        return bearing_of(value)
    return tuple(value) if isinstance(value, list) else value
