"""Registration of a batched task with Gymnasium, as single and as vector environment."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import gymnasium as gym
from gymnasium.vector import AutoresetMode

from gazelle.argument_checks import checked
from gazelle.envs.batched_task import BatchedTask
from gazelle.envs.goal_envs import TaskGoalEnv, TaskGoalVectorEnv
from gazelle.envs.goal_task import GoalSimulationTask
from gazelle.envs.limits import MAX_ENVS
from gazelle.envs.options import check_integer
from gazelle.envs.single_env import TaskEnv
from gazelle.envs.vector_env import TaskVectorEnv
from gazelle.errors import TaskError


@dataclass(frozen=True, slots=True)
class SingleEntry:
    """Entry point of one environment of a task.

    Attributes:
        registered_task: Makes the task of a number of worlds and options.
    """

    registered_task: Callable[..., BatchedTask]

    def __call__(
        self, seed: int | None = None, render_mode: str | None = None, **options: Any
    ) -> TaskEnv:
        """Return the environment, with goals where the task has them."""
        task = _made(self.registered_task, 1, options)
        if isinstance(task, GoalSimulationTask):
            return TaskGoalEnv(task, seed=seed, render_mode=render_mode)
        return TaskEnv(task, seed=seed, render_mode=render_mode)


@dataclass(frozen=True, slots=True)
class VectorEntry:
    """Entry point of many environments of a task; see `SingleEntry`."""

    registered_task: Callable[..., BatchedTask]

    def __call__(
        self,
        num_envs: int = 1,
        seed: int | None = None,
        render_mode: str | None = None,
        autoreset_mode: AutoresetMode | str = AutoresetMode.SAME_STEP,
        **options: Any,
    ) -> TaskVectorEnv:
        """Return the environments."""
        check_integer("num_envs", num_envs, 1, MAX_ENVS)
        task = _made(self.registered_task, num_envs, options)
        if isinstance(task, GoalSimulationTask):
            return TaskGoalVectorEnv(
                task, seed=seed, render_mode=render_mode, autoreset_mode=autoreset_mode
            )
        return TaskVectorEnv(
            task, seed=seed, render_mode=render_mode, autoreset_mode=autoreset_mode
        )


@checked(TaskError)
def register_task(
    task_id: str,
    task: Callable[..., BatchedTask],
    *,
    kwargs: Mapping[str, Any] | None = None,
) -> None:
    """Register a task with Gymnasium, for ``gymnasium.make``, ``make_vec`` and ``gazelle train``.

    ::

        gazelle.envs.register_task("my/Balance-v0", Balance)

    Environments take ``seed`` and ``render_mode``, vector ones also ``num_envs`` and
    ``autoreset_mode``; other options go to the task. Those of a `GoalSimulationTask` observe
    dicts. A class that is registered again, as its file was imported again, replaces the first.

    Args:
        task_id: As Gymnasium knows it, ``namespace/Name-v0``.
        task: Class of the task, or a function, called with the number of worlds and options.
        kwargs: Options that the id fixes, as of ``gymnasium.register``.

    Raises:
        TaskError: The task cannot be called, or Gymnasium refuses the id.
    """
    if not callable(task):
        raise TaskError(f"a task is a class or a function, not {task!r:.60}")
    if _is_earlier(task_id, task):
        del gym.registry[task_id]
    single, many, fixed = SingleEntry(task), VectorEntry(task), dict(kwargs or {})
    try:
        gym.register(task_id, single, vector_entry_point=many, kwargs=fixed)
    except gym.error.Error as error:
        raise TaskError(f"'{task_id}' cannot be registered: {error}") from error


def _made(
    registered: Callable[..., BatchedTask], nworld: int, options: Mapping[str, Any]
) -> BatchedTask:
    """Return the task of a number of worlds.

    Raises:
        TaskError: The registered callable makes something else.
    """
    made = registered(nworld, **options)
    if isinstance(made, BatchedTask):
        return made
    raise TaskError(
        f"what was registered makes a {type(made).__name__}, not a task",
        hint="register_task takes a subclass of BatchedTask, gymnasium.register an environment",
    )


def _is_earlier(task_id: str, task: Callable[..., BatchedTask]) -> bool:
    """Return whether an id is that of a task of the same name."""
    found = gym.registry[task_id].entry_point if task_id in gym.registry else None
    if not isinstance(found, SingleEntry):
        return False
    names = [getattr(each, "__qualname__", None) for each in (found.registered_task, task)]
    return names[0] == names[1] is not None
