"""The recipe of a task that may have none of its own: by what its environments are."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import gymnasium as gym
from gymnasium.vector import VectorEnv

from gazelle.envs.dict_rows import DictRows
from gazelle.training.goal_replay import goal_replay
from gazelle.training.importing import TaskModule, load_all
from gazelle.training.picture_layers import is_picture
from gazelle.training.recipes import GOALS, PICTURES, RECIPES, Recipe, recipe_for, task_name
from gazelle.training.tasks import entry_class, find_task, make_task, split_module

_REWARD = "compute_reward"


def task_recipe(
    task: str,
    algo: str | None = None,
    *,
    imports: Sequence[str | TaskModule] = (),
    options: Mapping[str, Any] | None = None,
) -> Recipe:
    """Return the recipe of a task: its own, or the one for goals, for pictures or for any task.

    A task without a recipe whose environments have goals, a ``compute_reward`` and continuous
    actions is trained with hindsight, as a reward at the goal alone hardly teaches others. One
    that observes a picture is trained for fewer steps, which cost more. One environment is made
    to find out.

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
    if algo not in (None, "ppo") or _has_own(bare):
        return recipe_for(bare, algo)
    found = find_task(bare)
    return recipe_for(found, algo) if _has_own(found) else _fitting(found, algo, options or {})


def listed_recipe(task: str) -> Recipe:
    """Return `task_recipe` of a registered task by its class, without making an environment."""
    if _has_own(task) or getattr(entry_class(task, vector=False), _REWARD, None) is None:
        return recipe_for(task)
    return GOALS


def _has_own(task: str) -> bool:
    return task_name(task).removesuffix("Continuous") in RECIPES


def _fitting(task: str, algo: str | None, options: Mapping[str, Any]) -> Recipe:
    """Return the recipe for what an environment of the task observes."""
    env = make_task(task, 1, **options)
    try:
        if algo is None and _has_goals(env):
            return GOALS
        return PICTURES if is_picture(env.single_observation_space) else recipe_for(task)
    finally:
        env.close()


def _has_goals(env: VectorEnv[Any, Any, Any]) -> bool:
    """Return whether an environment has all that hindsight needs."""
    space = env.single_observation_space
    continuous = isinstance(env.single_action_space, gym.spaces.Box)
    if not continuous or not isinstance(space, gym.spaces.Dict):
        return False
    boxes = all(isinstance(part, gym.spaces.Box) for part in space.spaces.values())
    return boxes and goal_replay(env, DictRows(space)) is not None
