"""Many copies of a task with what training needs to know of them; torch is not imported."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import gymnasium as gym
import numpy as np
import numpy.typing as npt
from gymnasium.vector import VectorEnv

from gazelle.array_types import Bools, Floats32
from gazelle.envs.contract import PolicyContract
from gazelle.training.contracts import task_contract
from gazelle.training.episodes import Episodes
from gazelle.training.goal_replay import GoalReplay, goal_replay
from gazelle.training.goal_reward import GoalReward
from gazelle.training.stepper import Stepper, TrainingStep
from gazelle.training.tasks import control_period


class TaskCopies:
    """The copies of a Gymnasium ``VectorEnv``, their episodes, and how they are saved.

    Args:
        env: The environment.
        reward_scale: Rewards are multiplied by this for the learner.
        goal_reward: Rewards of the learner in place of the task's; None for the task's.
        on_episodes: Called with the episodes that ended, at each step where some did.

    Attributes:
        env: The environment.
        reward_scale: Rewards are multiplied by this for the learner.
        starts: Mask of copies that begin an episode with `obs`, shape (N,).
        on_observations: Called with what is observed after each step, shape (N, ...), if set.
    """

    def __init__(
        self,
        env: VectorEnv[Any, Any, Any],
        *,
        reward_scale: float = 1.0,
        goal_reward: GoalReward | None = None,
        on_episodes: Callable[[Episodes], None] | None = None,
    ) -> None:
        self.env = env
        self.reward_scale = reward_scale
        self.on_episodes = on_episodes
        self.on_observations: Callable[[Floats32], None] | None = None
        self.starts: Bools = np.ones(env.num_envs, dtype=np.bool_)
        self._stepper = Stepper(env, goal_reward=goal_reward)

    @property
    def num_envs(self) -> int:
        """Number of copies."""
        return self.env.num_envs

    @property
    def obs(self) -> Floats32:
        """Observations that the policy acts on next, shape (N, ...)."""
        return self._stepper.obs

    @property
    def observation_space(self) -> gym.spaces.Box:
        """Space of one copy's observation, the parts of a Dict in a row."""
        return self._stepper.observation_space

    @property
    def goal_replay(self) -> GoalReplay | None:
        """Relabelling of steps with other goals; None if the task has no goals."""
        return goal_replay(self.env, self._stepper.rows)

    @property
    def control_period(self) -> float | None:
        """Simulated seconds of a control step; None if unknown."""
        return control_period(self.env)

    @property
    def contract(self) -> PolicyContract:
        """Contract of the task: the observations and actions of its policies."""
        return task_contract(self.env)

    def reset(self, seed: int | None = None) -> Floats32:
        """Start all episodes again; the first observations, shape (N, ...)."""
        self.starts = np.ones(self.num_envs, dtype=np.bool_)
        return self._stepper.reset(seed=seed)

    def advance(self, actions: npt.NDArray[Any]) -> TrainingStep:
        """Advance by one control step (rewards are not scaled)."""
        step = self._stepper.step(actions)
        if step.ended is not None and self.on_episodes is not None:
            self.on_episodes(step.ended)
        if self.on_observations is not None:
            self.on_observations(step.obs)
        self.starts = step.terminated | step.truncated
        return step

    def scaled(self, step: TrainingStep) -> Floats32:
        """Return the scaled rewards that the learner receives for a step, shape (N,)."""
        rewards: Floats32 = (step.taught * self.reward_scale).astype(np.float32)
        return rewards

    def get_state(self) -> dict[str, Any] | None:
        """Return the state that `set_state` restores; None if the environment cannot save it."""
        getter = getattr(self.env.unwrapped, "get_state", None)
        if getter is None or getattr(self.env.unwrapped, "set_state", None) is None:
            return None
        stepper = self._stepper.get_state()
        return {"environment": getter(), "stepper": stepper, "starts": self.starts}

    def set_state(self, state: dict[str, Any]) -> None:
        """Restore a state that `get_state` of an equal environment returned."""
        self.reset()
        self.env.unwrapped.set_state(state["environment"])  # type: ignore[attr-defined]  # it has one
        self._stepper.set_state(state["stepper"])
        self.starts = np.array(state["starts"], dtype=np.bool_)

    def close(self) -> None:
        """Close the environment."""
        self.env.close()
