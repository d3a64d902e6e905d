"""Change single values of a recipe by name, wherever in it they stand."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Any

from gazelle.errors import TaskError, did_you_mean
from gazelle.training.goal_reward import GoalReward
from gazelle.training.recipes import LibrarySettings, Recipe

_OWN = {"algo", "settings", "training_options", "evaluation_options"}


def with_values(recipe: Recipe, values: Mapping[str, Any]) -> Recipe:
    """A recipe in which some values are others.

    Args:
        recipe: How it is without them.
        values: By name: of a field of `Recipe` (``learning_rate``, ``net_arch`` ...), of its
            settings (``batch_size`` ...), or of its goal reward, as ``goal_reward.collision``.
            For an algorithm with `LibrarySettings`, any argument of its class.

    Raises:
        TaskError: There is no such value, or it cannot be.
    """
    fields = {each.name for each in dataclasses.fields(Recipe)} - _OWN
    library = isinstance(recipe.settings, LibrarySettings)
    inner = {each.name for each in dataclasses.fields(recipe.settings)}
    rewards = {f"goal_reward.{each.name}" for each in dataclasses.fields(GoalReward)}
    outer: dict[str, Any] = {}
    settings: dict[str, Any] = {}
    reward: dict[str, Any] = {}
    for name, value in values.items():
        if name in fields:
            outer[name] = tuple(value) if isinstance(value, list) else value
        elif name in rewards:
            reward[name.partition(".")[2]] = value
        elif library or name in inner:
            settings[name] = value
        else:
            hint = did_you_mean(name, fields | inner | rewards)
            raise TaskError(f"a recipe for {recipe.algo} has no '{name}'", hint=hint)
    if settings:
        outer["settings"] = _changed(recipe.settings, settings)
    if reward:
        outer["goal_reward"] = dataclasses.replace(recipe.goal_reward or GoalReward(), **reward)
    try:
        return dataclasses.replace(recipe, **outer)
    except TypeError as error:
        raise TaskError(f"a value of the recipe cannot be: {error}") from error


def _changed(settings: Any, values: dict[str, Any]) -> Any:
    if isinstance(settings, LibrarySettings):
        return LibrarySettings(options={**settings.options, **values})
    return dataclasses.replace(settings, **values)
