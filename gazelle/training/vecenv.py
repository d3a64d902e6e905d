"""A Gymnasium vector environment for Stable-Baselines3.

Stable-Baselines3 has its own vector interface, older than Gymnasium's. This
adapter steps all copies with one call and touches single copies only when
their episodes end.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt
from gymnasium.vector import VectorEnv

from gazelle.array_types import Bools, Floats32
from gazelle.envs.contract import PolicyContract
from gazelle.training.actor import Actor
from gazelle.training.copies import TaskCopies
from gazelle.training.episodes import Episodes
from gazelle.training.goal_replay import GoalReplay
from gazelle.training.goal_reward import GoalReward
from gazelle.training.rollout import Rollout, play
from gazelle.training.shared_vecenv import SharedVecEnv


class VectorEnvAdapter(SharedVecEnv):
    """Stable-Baselines3's ``VecEnv`` over a Gymnasium ``VectorEnv``.

    The infos of ended episodes hold ``terminal_observation`` and
    ``TimeLimit.truncated`` as Stable-Baselines3 defines them. A step that an
    environment spent on its reset (autoreset in the next step) has
    ``reset_step`` in its info, for `MaskedReplayBuffer` to leave out.

    Args:
        env: The environment.
        reward_scale: Rewards are multiplied by this.
        goal_reward: Rewards of the learner in place of the task's; None for the task's.
        on_episodes: Called with the episodes that ended, at each step where some did.

    Attributes:
        copies: The copies of the task.
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
        self.copies = TaskCopies(
            env, reward_scale=reward_scale, goal_reward=goal_reward, on_episodes=on_episodes
        )
        self._infos: list[dict[str, Any]] = [{} for _ in range(env.num_envs)]
        self._marked: npt.NDArray[np.intp] = np.zeros(0, dtype=np.intp)
        super().__init__(
            env.num_envs, self.copies.observation_space, env.single_action_space, shared=env
        )

    @property
    def obs(self) -> Floats32:
        """Observations that the policy acts on next, shape (N, ...)."""
        return self.copies.obs

    @property
    def starts(self) -> Bools:
        """Mask of copies that begin an episode with `obs`, shape (N,)."""
        return self.copies.starts

    @property
    def goal_replay(self) -> GoalReplay | None:
        """See `TaskCopies.goal_replay`."""
        return self.copies.goal_replay

    @property
    def control_period(self) -> float | None:
        """Simulated seconds of a control step; None if unknown."""
        return self.copies.control_period

    @property
    def contract(self) -> PolicyContract:
        """Contract of the task: the observations and actions of its policies."""
        return self.copies.contract

    def watch(self, on_observations: Callable[[Floats32], None]) -> None:
        """Call a function with the observations after each step, shape (N, ...)."""
        self.copies.on_observations = on_observations

    def collect(
        self,
        actor: Actor,
        steps: int,
        *,
        rng: np.random.Generator,
        on_step: Callable[[], bool] | None = None,
    ) -> Rollout | None:
        """Run a policy, see `rollout.play`."""
        return play(self.copies, actor, steps, rng=rng, on_step=on_step)

    def get_state(self) -> dict[str, Any] | None:
        """Return the state; see `TaskCopies.get_state`."""
        return self.copies.get_state()

    def set_state(self, state: dict[str, Any]) -> None:
        """Restore a state; see `TaskCopies.set_state`."""
        self.copies.set_state(state)

    def reset(self) -> Floats32:
        """Start all episodes again, with the seed given to `seed` if there is one."""
        obs = self.copies.reset(self._seed)
        self._seed = None
        return obs

    def step_wait(
        self,
    ) -> tuple[
        npt.NDArray[np.float32],
        npt.NDArray[np.float32],
        npt.NDArray[np.bool_],
        list[dict[str, Any]],
    ]:
        """Step; returns observations, rewards, dones, infos."""
        step = self.copies.advance(self._actions)
        for slot in self._marked:
            self._infos[slot] = {}
        if step.ended is not None and step.final_obs is not None:
            for slot, last in zip(step.ended.slots, step.final_obs, strict=True):
                truncated = bool(step.truncated[slot])
                self._infos[slot] = {
                    "terminal_observation": last,
                    "TimeLimit.truncated": truncated,
                }
        idle = np.flatnonzero(~step.valid)
        for slot in idle:
            self._infos[slot]["reset_step"] = True
        ended = step.ended.slots if step.ended is not None else idle[:0]
        self._marked = np.concatenate([ended, idle])
        return step.obs, self.copies.scaled(step), self.starts, self._infos

    def close(self) -> None:
        """Close the environment."""
        self.env.close()
