"""One way to step a Gymnasium vector environment, whatever its autoreset mode.

Gymnasium knows three modes (its manual, "Vector Environments: Autoreset"):

- same step: the step that ends an episode returns the first observation of the
  next one, and the last one in ``info["final_obs"]``;
- next step: the step that ends an episode returns its last observation, and the
  following step ignores its action and returns the first observation of the
  next episode. Nothing was learnt in that step, so it must not be learnt from;
- disabled: the caller resets with ``options={"reset_mask": mask}``.

`Stepper` turns all three into one record with the same meaning.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import gymnasium as gym
import numpy as np
import numpy.typing as npt
from gymnasium.vector import AutoresetMode, VectorEnv

from gazelle.errors import TaskError

Bools = npt.NDArray[np.bool_]
Floats = npt.NDArray[np.float32]
Doubles = npt.NDArray[np.float64]

OUTCOMES = ("is_success", "is_collision", "is_timeout")
"""The outcome of an episode, as boolean arrays in ``info["final_info"]``."""


@dataclass(frozen=True, slots=True)
class Episodes:
    """Episodes that ended in one step, in the order of their slots. Arrays have shape (k,)."""

    slots: npt.NDArray[np.intp]
    """Which copies of the environment they ran in."""
    returns: Doubles
    """Sums of rewards."""
    lengths: npt.NDArray[np.int64]
    """Control steps."""
    outcomes: dict[str, Bools]
    """For each name in `OUTCOMES` that the environment reports: whether it holds at the end."""
    goals: npt.NDArray[np.int64]
    """Steps with ``is_success``: more than one where an episode goes on to the next goal."""


@dataclass(frozen=True, slots=True)
class Step:
    """What one control step of all N copies brought."""

    obs: Floats
    """What the policy acts on next, shape (N, ...)."""
    rewards: Doubles
    """Shape (N,)."""
    terminated: Bools
    """Whether the episode came to its end, shape (N,)."""
    truncated: Bools
    """Whether the episode was cut off (and not terminated), shape (N,)."""
    valid: Bools
    """False where the copy spent this step on its reset, shape (N,)."""
    final_obs: Floats | None
    """Last observations of the ended episodes, shape (k, ...); None when no episode ended."""
    ended: Episodes | None
    """The ended episodes; None when no episode ended."""


class Stepper:
    """Steps a vector environment and keeps count of its episodes.

    Args:
        env: A Gymnasium vector environment with Box observations.

    Raises:
        TaskError: The observations are not a Box of numbers.
    """

    def __init__(self, env: VectorEnv[Any, Any, Any]) -> None:
        if not isinstance(env.single_observation_space, gym.spaces.Box):
            kind = type(env.single_observation_space).__name__
            raise TaskError(f"training needs observations in a Box, not in a {kind}")
        self.env = env
        self.num_envs = env.num_envs
        self.mode = AutoresetMode(env.metadata.get("autoreset_mode", AutoresetMode.NEXT_STEP))
        self.obs: Floats = np.zeros((0,), dtype=np.float32)
        self._resetting = np.zeros(self.num_envs, dtype=np.bool_)
        self._returns = np.zeros(self.num_envs)
        self._lengths = np.zeros(self.num_envs, dtype=np.int64)
        self._goals = np.zeros(self.num_envs, dtype=np.int64)

    def reset(self, *, seed: int | None = None) -> Floats:
        """Start all episodes anew and return the first observations, shape (N, ...)."""
        obs, _ = self.env.reset(seed=seed)
        self._resetting[:] = False
        self._returns[:] = 0.0
        self._lengths[:] = 0
        self._goals[:] = 0
        self.obs = np.array(obs, dtype=np.float32)
        return self.obs

    def step(self, actions: npt.NDArray[Any]) -> Step:
        """Do one control step in every copy.

        Args:
            actions: Shape (N,) or (N, number of actions), as the environment's space says.
        """
        obs, rewards, terminated, truncated, info = self.env.step(actions)
        valid = ~self._resetting
        rewards = np.where(valid, np.asarray(rewards, dtype=np.float64), 0.0)
        terminated = np.asarray(terminated, dtype=np.bool_) & valid
        truncated = np.asarray(truncated, dtype=np.bool_) & valid & ~terminated
        done = terminated | truncated
        self._returns += rewards
        self._lengths += valid
        if "is_success" in info:
            self._goals += np.asarray(info["is_success"], dtype=np.bool_) & valid & ~done
        obs = np.array(obs, dtype=np.float32)
        final_obs, ended = None, None
        if done.any():
            slots = np.flatnonzero(done)
            final_obs, info = self._last(obs, info, slots)
            ended = self._close_episodes(slots, info)
            if self.mode is AutoresetMode.DISABLED:
                obs = np.array(self.env.reset(options={"reset_mask": done})[0], dtype=np.float32)
        self._resetting = done if self.mode is AutoresetMode.NEXT_STEP else np.zeros_like(done)
        self.obs = obs
        return Step(obs, rewards, terminated, truncated, valid, final_obs, ended)

    def get_state(self) -> dict[str, Any]:
        """The stepper's own state (not the environment's)."""
        return {
            "obs": self.obs,
            "resetting": self._resetting,
            "returns": self._returns,
            "lengths": self._lengths,
            "goals": self._goals,
        }

    def set_state(self, state: dict[str, Any]) -> None:
        """Continue from a state that `get_state` returned."""
        self.obs = np.array(state["obs"], dtype=np.float32)
        self._resetting = np.array(state["resetting"], dtype=np.bool_)
        self._returns = np.array(state["returns"], dtype=np.float64)
        self._lengths = np.array(state["lengths"], dtype=np.int64)
        self._goals = np.array(state["goals"], dtype=np.int64)

    def _last(
        self, obs: Floats, info: dict[str, Any], slots: npt.NDArray[np.intp]
    ) -> tuple[Floats, dict[str, Any]]:
        """The last observations of the ended episodes, and the info that tells their outcome."""
        if self.mode is not AutoresetMode.SAME_STEP:
            return obs[slots], info
        if "final_obs" not in info:
            raise TaskError(
                'the environment resets in the same step but gives no info["final_obs"]',
                hint="a vector environment with AutoresetMode.SAME_STEP must return it",
            )
        last = info["final_obs"][slots]
        if last.dtype == np.object_:
            last = np.stack(list(last))
        return np.asarray(last, dtype=np.float32), info.get("final_info", info)

    def _close_episodes(self, slots: npt.NDArray[np.intp], info: dict[str, Any]) -> Episodes:
        outcomes = {
            name: np.asarray(info[name])[slots].astype(np.bool_)
            for name in OUTCOMES
            if name in info
        }
        goals = self._goals[slots] + outcomes.get("is_success", np.zeros(len(slots), np.bool_))
        ended = Episodes(slots, self._returns[slots], self._lengths[slots], outcomes, goals)
        self._returns[slots] = 0.0
        self._lengths[slots] = 0
        self._goals[slots] = 0
        return ended
