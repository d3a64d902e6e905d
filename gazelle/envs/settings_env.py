"""Environments of tasks that are made of a number of worlds and of settings."""

from __future__ import annotations

from collections.abc import Callable
from inspect import getattr_static
from typing import Any, ClassVar

from gymnasium.vector import AutoresetMode

from gazelle.envs.batched_task import BatchedTask
from gazelle.envs.limits import MAX_ENVS
from gazelle.envs.options import TaskSettings, check_integer, read_options
from gazelle.envs.single_env import TaskEnv
from gazelle.envs.vector_env import TaskVectorEnv


class SettingsEnv(TaskEnv):
    """One world of a task; a subclass says which task, and takes its settings as options.

    Args:
        options: The fields of ``settings_class``.

    Raises:
        TaskError: There is no such option, or it cannot have that value.

    Attributes:
        task_class: Makes the task of a number of worlds and settings.
        settings_class: The task's options.
    """

    task_class: ClassVar[Callable[..., BatchedTask]]
    settings_class: ClassVar[type[TaskSettings]] = TaskSettings

    def __init__(self, **options: Any) -> None:
        settings = read_options(self.settings_class, options)
        task = type(self).task_class(1, settings)
        super().__init__(task, seed=settings.seed, render_mode=settings.render_mode)


class SettingsVectorEnv(TaskVectorEnv):
    """Many worlds of a task; see `SettingsEnv`.

    Args:
        num_envs: Number of environments.
        autoreset_mode: See `TaskVectorEnv`.
        options: The fields of ``settings_class``.

    Raises:
        TaskError: There is no such option, or it cannot have that value.

    Attributes:
        task_class: Makes the task of a number of worlds and settings.
        settings_class: The task's options.
    """

    task_class: ClassVar[Callable[..., BatchedTask]]
    settings_class: ClassVar[type[TaskSettings]] = TaskSettings

    def __init__(
        self,
        num_envs: int = 1,
        autoreset_mode: AutoresetMode | str = AutoresetMode.SAME_STEP,
        **options: Any,
    ) -> None:
        check_integer("num_envs", num_envs, 1, MAX_ENVS)
        settings = read_options(self.settings_class, options)
        super().__init__(
            type(self).task_class(num_envs, settings),
            seed=settings.seed,
            render_mode=settings.render_mode,
            autoreset_mode=autoreset_mode,
        )


def many_worlds(single: type[SettingsEnv]) -> type[SettingsVectorEnv]:
    """Return the class of many worlds of a task, named after that of one world."""
    shared = ("task_class", "settings_class", "evaluation_options")
    members = {each: getattr_static(single, each) for each in shared if hasattr(single, each)}
    members["__doc__"] = f"`{single.__name__}` in many worlds at once; that page is the data sheet."
    members["__module__"] = single.__module__
    name = single.__name__.removesuffix("Env") + "VectorEnv"
    return type(name, (SettingsVectorEnv,), members)
