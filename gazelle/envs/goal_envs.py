"""A batched task with goals as Gymnasium environments with a Dict of observations."""

from __future__ import annotations

from typing import Any

import numpy as np
from gymnasium.vector import AutoresetMode
from gymnasium.vector.utils import batch_space
from numpy.typing import ArrayLike, NDArray

from gazelle.array_types import Bools, Floats, Floats32
from gazelle.envs.goal_task import GoalSimulationTask
from gazelle.envs.single_env import TaskEnv
from gazelle.envs.vector_env import TaskVectorEnv
from gazelle.errors import TaskError

Parts = dict[str, Floats32]
"""``observation``, ``achieved_goal`` and ``desired_goal``."""


class TaskGoalVectorEnv(TaskVectorEnv):
    """A task with goals as a Gymnasium vector environment.

    Observations are a dict of arrays with the keys ``observation``, ``achieved_goal`` and
    ``desired_goal``, as of Gymnasium-Robotics' ``GoalEnv``; all else is as `TaskVectorEnv` says.

    Args:
        task: Task to wrap; the environment closes it.
        seed: Of the first episodes when ``reset`` gets none.
        render_mode: ``rgb_array``, or None.
        autoreset_mode: One of Gymnasium's, or its name.
    """

    task: GoalSimulationTask

    def __init__(
        self,
        task: GoalSimulationTask,
        *,
        seed: int | None = None,
        render_mode: str | None = None,
        autoreset_mode: AutoresetMode | str = AutoresetMode.SAME_STEP,
    ) -> None:
        super().__init__(task, seed=seed, render_mode=render_mode, autoreset_mode=autoreset_mode)
        self.single_observation_space = task.rows.space
        self.observation_space = batch_space(task.rows.space, task.nworld)

    def reset(  # type: ignore[override]  # parts instead of rows
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Parts, dict[str, Any]]:
        """Reset the environments; see `TaskVectorEnv.reset`."""
        rows, info = super().reset(seed=seed, options=options)
        return self.task.rows.split(rows), info

    def step(  # type: ignore[override]  # parts instead of rows
        self, actions: ArrayLike
    ) -> tuple[Parts, Floats, Bools, Bools, dict[str, Any]]:
        """Step the environments; each ``info["final_obs"]`` is a dict too.

        See `TaskVectorEnv.step`.
        """
        rows, reward, terminated, truncated, info = super().step(actions)
        if "final_obs" in info:
            worlds = np.flatnonzero(info["_final_obs"])
            last = self.task.rows.split(np.stack(list(info["final_obs"][worlds])))
            for row, world in enumerate(worlds):
                info["final_obs"][world] = {key: part[row] for key, part in last.items()}
        return self.task.rows.split(rows), reward, terminated, truncated, info

    def compute_reward(
        self, achieved_goal: NDArray[Any], desired_goal: NDArray[Any], info: object
    ) -> NDArray[Any]:
        """Return the reward; see `GoalSimulationTask.compute_reward`."""
        return _reward(self.task, achieved_goal, desired_goal, info)


class TaskGoalEnv(TaskEnv):
    """A task of one world with goals as a Gymnasium environment.

    Observations are a dict with the keys ``observation``, ``achieved_goal`` and ``desired_goal``,
    as of Gymnasium-Robotics' ``GoalEnv``, so that Stable-Baselines3's ``HerReplayBuffer`` takes
    it; all else is as `TaskEnv` says.

    Args:
        task: A task of one world; the environment closes it.
        seed: Of the first episode when ``reset`` gets none.
        render_mode: ``rgb_array``, or None.
    """

    task: GoalSimulationTask

    def __init__(
        self, task: GoalSimulationTask, *, seed: int | None = None, render_mode: str | None = None
    ) -> None:
        super().__init__(task, seed=seed, render_mode=render_mode)
        self.observation_space = task.rows.space

    def reset(  # type: ignore[override]  # parts instead of a row
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Parts, dict[str, Any]]:
        """Reset the environment; see `TaskEnv.reset`."""
        row, info = super().reset(seed=seed, options=options)
        return self._parts(row), info

    def step(  # type: ignore[override]  # parts instead of a row
        self, action: Any
    ) -> tuple[Parts, float, bool, bool, dict[str, Any]]:
        """Step the environment; see `TaskEnv.step`."""
        row, reward, terminated, truncated, info = super().step(action)
        return self._parts(row), reward, terminated, truncated, info

    def compute_reward(
        self, achieved_goal: NDArray[Any], desired_goal: NDArray[Any], info: object
    ) -> NDArray[Any]:
        """Return the reward; see `GoalSimulationTask.compute_reward`."""
        return _reward(self.task, achieved_goal, desired_goal, info)

    def _parts(self, row: Floats32) -> Parts:
        return {key: part[0] for key, part in self.task.rows.split(row[None]).items()}


def _reward(
    task: GoalSimulationTask, achieved: NDArray[Any], desired: NDArray[Any], info: object
) -> NDArray[Any]:
    """Return the reward, for goals of checked shapes."""
    shape = task.goal_space.shape
    for goals in (achieved, desired):
        if np.shape(goals)[-len(shape) :] != shape:
            raise TaskError(f"goals have the shape (..., {shape[0]}), not {np.shape(goals)}")
    try:
        return task.compute_reward(achieved, desired, info)
    except ValueError as error:
        raise TaskError(f"these goals do not fit each other: {error}") from error
