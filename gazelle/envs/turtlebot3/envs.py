"""The TurtleBot3 tasks as Gymnasium environments."""

from __future__ import annotations

from typing import ClassVar, Unpack

from gazelle.envs.options import (
    NavigationOptions,
    NavigationSettings,
    check_whole,
    read_options,
)
from gazelle.envs.single_env import TaskEnv
from gazelle.envs.turtlebot3.task import TurtleBot3Task
from gazelle.envs.vector_env import TaskVectorEnv


class TurtleBot3Env(TaskEnv):
    """DATA SHEET"""

    continuous: ClassVar[bool] = False

    def __init__(self, stage: int = 1, **options: Unpack[NavigationOptions]) -> None:
        settings = read_options(NavigationSettings, options)
        task = TurtleBot3Task(stage, 1, continuous=self.continuous, settings=settings)
        super().__init__(task, seed=settings.seed, render_mode=settings.render_mode)


class TurtleBot3ContinuousEnv(TurtleBot3Env):
    """CONT"""

    continuous: ClassVar[bool] = True


class TurtleBot3VectorEnv(TaskVectorEnv):
    """VEC"""

    continuous: ClassVar[bool] = False

    def __init__(
        self, num_envs: int = 1, stage: int = 1, **options: Unpack[NavigationOptions]
    ) -> None:
        check_whole("num_envs", num_envs, 1)
        settings = read_options(NavigationSettings, options)
        task = TurtleBot3Task(stage, num_envs, continuous=self.continuous, settings=settings)
        super().__init__(task, seed=settings.seed, render_mode=settings.render_mode)


class TurtleBot3ContinuousVectorEnv(TurtleBot3VectorEnv):
    """VEC CONT"""

    continuous: ClassVar[bool] = True
