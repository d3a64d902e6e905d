"""The recipe of a task that may have none of its own: by what its environments are."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import gymnasium as gym

from gazelle.envs.dict_rows import DictRows
from gazelle.training.goal_replay import goal_replay
from gazelle.training.importing import TaskModule, load_all
from gazelle.training.recipes import GOALS, RECIPES, Recipe, recipe_for, task_name
from gazelle.training.tasks import entry_class, find_task, make_task, split_module

_REWARD = "compute_reward"


def task_recipe(
    task: str,
    algo: str | None = None,
    *,
    imports: Sequence[str | TaskModule] = (),
    options: Mapping[str, Any] | None = None,
) -> Recipe:
    """Return the recipe of a task: its own, or the one for tasks with goals, or the one for any.

    A task without a recipe whose environments have goals, a ``compute_reward`` and continuous
    actions is trained with hindsight, as a reward at the goal alone hardly teaches others.

    Args:
        task: As `gazelle.training.train` takes it.
        algo: See `recipe_for`.
        imports: Modules or files to import first.
        options: Of the environment.

    Raises:
        TaskError: There is no such task or algorithm, or it has no such option.
    """
    module, bare = split_module(task)
    load_all([*imports, *([] if module is None else [module])])
    if algo is not None or _has_own(bare):
        return recipe_for(bare, algo)
    found = find_task(bare)
    if _has_own(found):
        return recipe_for(found)
    return (
        GOALS if _may_have_goals(found) and _has_goals(found, options or {}) else recipe_for(bare)
    )


def listed_recipe(task: str) -> Recipe:
    """Return `task_recipe` of a registered task by its class, without making an environment."""
    if _has_own(task) or getattr(entry_class(task, vector=False), _REWARD, None) is None:
        return recipe_for(task)
    return GOALS


def _has_own(task: str) -> bool:
    return task_name(task).removesuffix("Continuous") in RECIPES


def _may_have_goals(task: str) -> bool:
    """Return whether the task may have goals: False where its classes exclude it."""
    entries = [entry_class(task, vector=vector) for vector in (True, False)]
    return any(
        each is not None and (not isinstance(each, type) or hasattr(each, _REWARD))
        for each in entries
    )


def _has_goals(task: str, options: Mapping[str, Any]) -> bool:
    """Return whether an environment of the task has all that hindsight needs."""
    env = make_task(task, 1, **options)
    try:
        space = env.single_observation_space
        continuous = isinstance(env.single_action_space, gym.spaces.Box)
        if not continuous or not isinstance(space, gym.spaces.Dict):
            return False
        boxes = all(isinstance(part, gym.spaces.Box) for part in space.spaces.values())
        return boxes and goal_replay(env, DictRows(space)) is not None
    finally:
        env.close()
