"""A batched task of one world as a Gymnasium environment."""

from __future__ import annotations

from typing import Any, ClassVar

import gymnasium as gym
import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats32
from gazelle.envs.batched_task import BatchedTask, Info
from gazelle.envs.contract import PolicyContract
from gazelle.envs.errors import check_open
from gazelle.envs.options import RENDER_MODES, check_name, checked_mapping, checked_seed
from gazelle.envs.row_checks import action_array
from gazelle.envs.vector_env import TaskVectorEnv


class TaskEnv(gym.Env[Any, Any]):
    """A batched task of one world as a Gymnasium environment.

    It is world 0 of the vector environment: the same seed and actions give the same bits. It can
    be pickled and copied, and both continue with the same future.

    Args:
        task: A task of one world; the environment closes it.
        seed: Of the first episode when ``reset`` gets none.
        render_mode: ``rgb_array``, or None.

    Attributes:
        control_period: Simulated time of one step [s].
    """

    metadata: ClassVar[dict[str, Any]] = {"render_modes": list(RENDER_MODES)}  # type: ignore[misc]  # as there

    def __init__(
        self, task: BatchedTask, *, seed: int | None = None, render_mode: str | None = None
    ) -> None:
        self._vector = TaskVectorEnv(task, seed=seed)
        self.task = task
        self.observation_space = task.observation_space
        self.action_space = task.action_space
        self.control_period = task.control_period
        self.render_mode = render_mode
        self.metadata = {**type(self).metadata, "render_fps": 1.0 / task.control_period}  # type: ignore[misc]

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Floats32, dict[str, Any]]:
        """Start a new episode.

        Args:
            seed: Starts all random numbers over.
            options: None is supported yet.

        Raises:
            TaskError: An option that does not exist.
            ClosedEnvError: The environment is closed.
        """
        for name in checked_mapping("reset options", options):
            check_name("reset option", name, [])
        if seed is not None:
            seed = checked_seed(seed)
            super().reset(seed=seed)
        observation, info = self._vector.reset(seed=seed)
        if self._np_random is None:
            super().reset(seed=self._vector.np_random_seed)
        return observation[0], _of_world_0(info)

    def step(self, action: Any) -> tuple[Floats32, float, bool, bool, dict[str, Any]]:
        """Step the environment once.

        Raises:
            TaskError: The action has the wrong shape or value.
            ResetNeededError: Nothing was reset yet.
            ClosedEnvError: The environment is closed.
        """
        self._vector.check_ready("step()")
        result = self.task.advance(action_array(action)[None])
        return (
            result.observation[0],
            float(result.reward[0]),
            bool(result.terminated[0]),
            bool(result.truncated[0]),
            _of_world_0(result.info),
        )

    @property
    def contract(self) -> PolicyContract:
        """Contract of this task's policies, see `BatchedTask.contract`."""
        return self.task.contract

    def render(self) -> NDArray[np.uint8] | None:
        """Return a picture, shape (height, width, 3); None without render mode.

        Raises:
            ClosedEnvError: The environment is closed.
        """
        check_open("render()", closed=self._vector.closed)
        return None if self.render_mode is None else self.task.render(0)

    def get_state(self) -> dict[str, Any]:
        """Return the whole state; see `TaskVectorEnv.get_state`."""
        return self._vector.get_state()

    def set_state(self, state: dict[str, Any]) -> None:
        """Restore a state; see `TaskVectorEnv.set_state`."""
        self._vector.set_state(state)
        if self._np_random is None:
            super().reset(seed=self._vector.np_random_seed)

    def close(self) -> None:
        """Free the simulation; a second call does nothing."""
        self._vector.close()


def _of_world_0(info: Info) -> dict[str, Any]:
    """Return plain numbers and arrays of world 0, without the masks."""
    return {
        name: values.item(0) if values.ndim == 1 else values[0].copy()
        for name, values in info.items()
        if name[:1] != "_"
    }
