"""Base class of goal-conditioned tasks in a simulation, with hindsight goals."""

from __future__ import annotations

from abc import abstractmethod
from typing import Any

import gymnasium as gym
import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Bools, Floats, Floats32, Worlds
from gazelle.envs.contract import PolicyContract, generic_contract
from gazelle.envs.dict_rows import ACHIEVED, DESIRED, OBSERVATION, DictRows
from gazelle.envs.simulation_task import SimulationTask, StepOutcome
from gazelle.errors import TaskError
from gazelle.simulation import Simulation

_GOAL = "goal"


class GoalSimulationTask(SimulationTask):
    """A task in which each episode has a goal, in all worlds of a simulation.

    A subclass sets ``observation_space`` (of the part ``observation`` alone), ``goal_space`` and
    ``action_space``, and says what happens in `start`, `observe`, `act` and in `draw_goals`,
    `achieved` and `reached`; `TaskGoalEnv` and `TaskGoalVectorEnv` make environments of it, whose
    observations have the keys ``observation``, ``achieved_goal`` and ``desired_goal``.

    Within the task an observation is a row of these three, see `DictRows`.

    Args:
        simulation: See `SimulationTask`.
        control_period: Simulated time of a control step [s].
        max_episode_steps: Control steps until an episode is truncated; None for no limit.

    Raises:
        TaskError: A space is missing or no Box, or the control period does not fit.

    Attributes:
        goal_space: Of one goal.
        rows: Layout of observation and goals in a row.
    """

    goal_space: gym.spaces.Box
    rows: DictRows

    def __init__(
        self,
        simulation: Simulation,
        *,
        control_period: float,
        max_episode_steps: int | None = None,
    ) -> None:
        super().__init__(
            simulation, control_period=control_period, max_episode_steps=max_episode_steps
        )
        for name in ("observation_space", "goal_space"):
            if not isinstance(getattr(self, name, None), gym.spaces.Box):
                raise TaskError(
                    f"{type(self).__name__} has no Box as {name}",
                    hint="set observation_space and goal_space before super().__init__()",
                )
        self.rows = DictRows(
            gym.spaces.Dict(
                {
                    OBSERVATION: self.observation_space,
                    ACHIEVED: self.goal_space,
                    DESIRED: self.goal_space,
                }
            )
        )
        self.memory[_GOAL] = np.zeros((self.nworld, *self.goal_space.shape))

    @abstractmethod
    def draw_goals(self, worlds: Worlds) -> Floats:
        """Return goals of the episodes that start in these worlds, after `start`.

        Shape (n, ...).
        """

    @abstractmethod
    def achieved(self, worlds: Worlds | None) -> Floats:
        """Return the achieved goals of these worlds (all if None), shape (n, ...)."""

    @abstractmethod
    def reached(self, achieved: NDArray[Any], desired: NDArray[Any]) -> Bools:
        """Return whether the achieved state is the desired one.

        Args:
            achieved: Shape (..., size), any number of leading axes.
            desired: Likewise.

        Returns:
            Shape (...).
        """

    def compute_reward(
        self, achieved_goal: NDArray[Any], desired_goal: NDArray[Any], info: object
    ) -> NDArray[Any]:
        """Return the reward of steps after which this is achieved, were that the goal.

        By default 0 where it is reached and -1 elsewhere. It depends on the arguments alone, so
        that it returns what a step had been worth with another goal.

        Args:
            achieved_goal: Shape (..., size), any number of leading axes.
            desired_goal: Likewise.
            info: Of the steps; not looked at.

        Returns:
            Shape (...), float64.
        """
        del info
        return np.where(self.reached(achieved_goal, desired_goal), 0.0, -1.0)

    @property
    def goals(self) -> Floats:
        """The goals of the running episodes, shape (nworld, ...)."""
        return self.memory[_GOAL]

    @property
    def row_space(self) -> gym.spaces.Box:
        """Space of observation and goals in a row."""
        return self.rows.row_space

    @property
    def contract(self) -> PolicyContract:
        """Contract of its policies: the three parts in a row."""
        return generic_contract(self.rows.space, self.action_space, self.control_period)

    def outcome(self, observation: Floats32) -> StepOutcome:
        """Return reward and success; episodes end by their time limit.

        Args:
            observation: Rows of the three parts, shape (nworld, size).
        """
        achieved, desired = self.goal_parts(observation)
        info: dict[str, NDArray[Any]] = {"is_success": self.reached(achieved, desired)}
        reward = np.asarray(self.compute_reward(achieved, desired, info), np.float64)
        if reward.shape != (self.nworld,):
            raise TaskError(
                f"compute_reward returned an array of shape {reward.shape} for {self.nworld} goals",
                hint="sum over the last axis alone, as in norm(achieved - desired, axis=-1)",
            )
        return StepOutcome(reward, np.zeros(self.nworld, np.bool_), info)

    def goal_parts(self, rows: Floats32) -> tuple[Floats32, Floats32]:
        """Return the achieved and the desired goals of rows of shape (n, size).

        Raises:
            TaskError: The rows have another shape.
        """
        if rows.shape[1:] != (self.rows.size,):
            raise TaskError(f"rows have the shape (n, {self.rows.size}), not {rows.shape}")
        shape = (len(rows), *self.goal_space.shape)
        slices = self.rows.slices
        return rows[:, slices[ACHIEVED]].reshape(shape), rows[:, slices[DESIRED]].reshape(shape)

    def _begin(self, worlds: Worlds) -> None:
        super()._begin(worlds)
        goals = np.asarray(self.draw_goals(worlds), np.float64)
        self._check("draw_goals", goals, (len(worlds), *self.goal_space.shape), "goal_space")
        self.memory[_GOAL][worlds] = goals

    def _seen(self, worlds: Worlds | None) -> Floats32:
        count = self.nworld if worlds is None else len(worlds)
        achieved = np.asarray(self.achieved(worlds), np.float64)
        self._check("achieved", achieved, (count, *self.goal_space.shape), "goal_space")
        return self.rows.join(
            {
                OBSERVATION: super()._seen(worlds),
                ACHIEVED: achieved,
                DESIRED: self.goals if worlds is None else self.goals[worlds],
            }
        )

    def _check(self, method: str, found: Floats, shape: tuple[int, ...], space: str) -> None:
        if found.shape != shape:
            raise TaskError(
                f"{method} returned an array of shape {found.shape}, expected {shape} by {space}",
                hint="expected a row per world, with an entry per bound of the space",
            )
