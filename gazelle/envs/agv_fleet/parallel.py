"""The fleet under PettingZoo's parallel API."""

from __future__ import annotations

from typing import Any, ClassVar, Unpack

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats32
from gazelle.envs.agv_fleet.task import PERIOD, AGVFleetTask, FleetOptions, FleetSettings
from gazelle.envs.batched_task import Info
from gazelle.envs.errors import check_open, check_ready
from gazelle.envs.options import read_options
from gazelle.errors import MissingExtraError

try:
    from pettingzoo import ParallelEnv
except ImportError as error:
    raise MissingExtraError("pettingzoo", "marl") from error

_STEPS = 500


class AGVFleetParallelEnv(ParallelEnv):  # type: ignore[misc]  # PettingZoo has no types
    """AGVs in one hall, each an agent; `AGVFleetVectorEnv` is the data sheet.

    An agent that bumps into something is done, and its AGV stays where it is until ``reset``.
    All are truncated together after ``max_episode_steps``, 500 by default.

    Args:
        options: As there; ``agents`` is their number.

    Raises:
        TaskError: An option is invalid.
    """

    metadata: ClassVar[dict[str, Any]] = {
        "name": "agv_fleet_v0",
        "render_modes": ["rgb_array"],
        "render_fps": 1.0 / PERIOD,
        "is_parallelizable": True,
    }

    def __init__(self, **options: Unpack[FleetOptions]) -> None:
        options.setdefault("max_episode_steps", _STEPS)
        settings = read_options(FleetSettings, options)
        self.task = AGVFleetTask(settings.agents, settings)
        self.render_mode = settings.render_mode
        self.possible_agents = [f"agv_{number}" for number in range(settings.agents)]
        self._index = {name: number for number, name in enumerate(self.possible_agents)}
        self.agents: list[str] = []
        self._seed = settings.seed
        self._begun = self._closed = False

    def observation_space(self, agent: str) -> Any:
        """Return the space of one agent; they are all the same."""
        del agent
        return self.task.observation_space

    def action_space(self, agent: str) -> Any:
        """Return the space of one agent; they are all the same."""
        del agent
        return self.task.action_space

    def reset(
        self, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[dict[str, Floats32], dict[str, dict[str, Any]]]:
        """Start a new episode with all agents.

        Args:
            seed: Starts all random numbers over.
            options: None is supported.

        Raises:
            ClosedEnvError: The environment is closed.
        """
        check_open("reset()", closed=self._closed)
        del options
        if seed is None and not self._begun:
            fresh = int(np.random.SeedSequence().generate_state(1)[0])
            seed = fresh if self._seed is None else self._seed
        if seed is not None:
            self.task.seed(seed)
        self._begun = True
        self.agents = list(self.possible_agents)
        observation, info = self.task.begin(np.arange(self.task.nworld))
        return self._each(observation), self._infos(info)

    def step(
        self, actions: dict[str, NDArray[Any]]
    ) -> tuple[
        dict[str, Floats32],
        dict[str, float],
        dict[str, bool],
        dict[str, bool],
        dict[str, dict[str, Any]],
    ]:
        """Step the environment once.

        Args:
            actions: Of the agents that are left; one without an action stands.

        Raises:
            TaskError: An action has the wrong shape or values.
            ResetNeededError: Nothing was reset yet.
            ClosedEnvError: The environment is closed.
        """
        check_ready("step()", closed=self._closed, begun=self._begun)
        table = np.tile([-1.0, 0.0], (self.task.nworld, 1))
        for agent, action in actions.items():
            table[self._index[agent]] = action
        result = self.task.advance(table)
        terminated = {agent: bool(result.terminated[self._index[agent]]) for agent in self.agents}
        truncated = {agent: bool(result.truncated[self._index[agent]]) for agent in self.agents}
        answer = (
            self._each(result.observation),
            {agent: float(result.reward[self._index[agent]]) for agent in self.agents},
            terminated,
            truncated,
            self._infos(result.info),
        )
        crashed = [self._index[agent] for agent in self.agents if terminated[agent]]
        self.task.freeze(np.array(crashed, np.intp))
        self.agents = [
            agent for agent in self.agents if not (terminated[agent] or truncated[agent])
        ]
        return answer

    def render(self) -> NDArray[np.uint8] | None:
        """Return the hall from above; None without render mode.

        Raises:
            ClosedEnvError: The environment is closed.
        """
        check_open("render()", closed=self._closed)
        return None if self.render_mode is None else self.task.render(0)

    def close(self) -> None:
        """Stop the threads; a second call does nothing."""
        self._closed = True
        self.task.close()

    def _each(self, values: Floats32) -> dict[str, Floats32]:
        return {agent: values[self._index[agent]].copy() for agent in self.agents}

    def _infos(self, info: Info) -> dict[str, dict[str, Any]]:
        return {
            agent: {name: values[self._index[agent]] for name, values in info.items()}
            for agent in self.agents
        }
