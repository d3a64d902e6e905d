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

from gazelle.array_types import Bools, Floats, Floats32
from gazelle.envs.dict_rows import DictRows
from gazelle.errors import TaskError
from gazelle.training.episodes import OUTCOMES, Episodes, begins_early
from gazelle.training.goal_reward import GoalReward, GoalRewards
from gazelle.training.picture_layers import observation_dtype
from gazelle.training.state_arrays import saved_array
from gazelle.training.tasks import step_limit

SCENARIO = "scenario"
"""In the info of an episode's first moment: numbers that set it apart from others."""

_FEW = 8  # numbers of an info that a record of an episode keeps at most


@dataclass(frozen=True, slots=True)
class TrainingStep:
    """Result of one control step of all N copies."""

    obs: Floats32
    """Observations that the policy acts on next, shape (N, ...)."""
    rewards: Floats
    """As the task gives them, shape (N,)."""
    taught: Floats
    """Rewards for the learner in their place, shape (N,)."""
    terminated: Bools
    """True where the episode terminated, shape (N,)."""
    truncated: Bools
    """True where the episode was cut off (and not terminated), shape (N,)."""
    valid: Bools
    """False where the copy spent this step on its reset, shape (N,)."""
    final_obs: Floats32 | None
    """Last observations of the ended episodes, shape (k, ...); None when no episode ended."""
    ended: Episodes | None
    """The ended episodes; None when no episode ended."""

    @property
    def begun(self) -> Bools:
        """Mask of copies with ``obs`` of another episode than the step, shape (N,).

        A policy with a memory forgets there. In autoreset mode "next step" the last observation of an
        episode is one of them, too, as nothing is done with it.
        """
        return self.terminated | self.truncated | ~self.valid


class Stepper:
    """Steps a vector environment and keeps count of its episodes.

    Args:
        env: A Gymnasium vector environment with observations that are a Box, or a Dict of boxes: then
            its parts in a row are what is learnt from.
        keep_info: Whether ended episodes keep all numbers of their last info.
        goal_reward: Rewards of the learner in place of the task's; None for the task's.

    Raises:
        TaskError: The observations are neither.

    Attributes:
        observation_space: Of one copy, a Box.
        rows: Layout of the parts of a Dict in a row; None if the observations are a Box.
        obs: Next observations of the policy, shape (N, ...).
        scenarios: Scenarios of the running episodes by the environment, shape (N, size);
            None if it says nothing.
    """

    def __init__(
        self,
        env: VectorEnv[Any, Any, Any],
        *,
        keep_info: bool = False,
        goal_reward: GoalReward | None = None,
    ) -> None:
        self.observation_space, self.rows = _learnable(env.single_observation_space)
        self._dtype = observation_dtype(self.observation_space)
        self.env = env
        self.num_envs = env.num_envs
        self.mode = AutoresetMode(env.metadata.get("autoreset_mode", AutoresetMode.NEXT_STEP))
        self.obs: Floats32 = np.zeros((0,), dtype=np.float32)
        self._resetting = np.zeros(self.num_envs, dtype=np.bool_)
        self._returns = np.zeros(self.num_envs)
        self._lengths = np.zeros(self.num_envs, dtype=np.int64)
        self._goals = np.zeros(self.num_envs, dtype=np.int64)
        self._late_goals = np.zeros(self.num_envs, dtype=np.int64)
        self._goal_at = np.zeros(self.num_envs, dtype=np.int64)
        self._there = np.zeros(self.num_envs, dtype=np.bool_)
        self._limit = step_limit(env)
        self.scenarios: Floats | None = None
        self._keep_info = keep_info
        self._teacher = None if goal_reward is None else GoalRewards(goal_reward, env.num_envs)

    def reset(self, *, seed: int | None = None) -> Floats32:
        """Start all episodes again and return the first observations, shape (N, ...)."""
        obs, info = self.env.reset(seed=seed)
        self._resetting[:] = False
        self._forget(np.arange(self.num_envs))
        self.scenarios = None
        everywhere = np.ones(self.num_envs, dtype=np.bool_)
        self._note_scenarios(info, everywhere)
        if self._teacher is not None:
            self._teacher.begin(info, everywhere)
        self.obs = self._array(obs)
        return self.obs

    def step(self, actions: npt.NDArray[Any]) -> TrainingStep:
        """Step every copy once.

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
        began = self._resetting
        self._count_goals(info, valid, done)
        obs = self._array(obs)
        final_obs, ended, last = None, None, None
        slots = np.flatnonzero(done)
        if len(slots):
            final_obs, last = self._last(obs, info, slots)
        taught = self._taught(rewards, info, last, slots, terminated, valid)
        if last is not None:
            ended = self._close_episodes(slots, last, truncated)
            if self.mode is AutoresetMode.DISABLED:
                fresh, info = self.env.reset(options={"reset_mask": done})
                obs = self._array(fresh)
            began = done
        if self.mode is AutoresetMode.NEXT_STEP:
            began, self._resetting = self._resetting, done
        self._note_scenarios(info, began)
        if self._teacher is not None and began.any():
            self._teacher.begin(info, began)
        self.obs = obs
        return TrainingStep(obs, rewards, taught, terminated, truncated, valid, final_obs, ended)

    def _taught(
        self,
        rewards: Floats,
        info: dict[str, Any],
        last: dict[str, Any] | None,
        slots: npt.NDArray[np.intp],
        terminated: Bools,
        valid: Bools,
    ) -> Floats:
        """Return the rewards that the learner receives for a step."""
        if self._teacher is None:
            return rewards
        paid = self._teacher.of_step(info, last, slots, terminated, valid)
        return paid + self._teacher.pay.own * np.where(valid, rewards, 0.0)

    def _count_goals(self, info: dict[str, Any], valid: Bools, done: Bools) -> None:
        """Count goals reached on the way; those of a last step are counted when it is closed."""
        if "is_success" not in info:
            return
        there = np.asarray(info["is_success"], dtype=np.bool_) & valid & ~done
        # A goal at which a task keeps its robot is reached once.
        came = there & ~self._there
        self._goals += came
        self._late_goals += came & self._begun_late()
        self._goal_at[came] = self._lengths[came]
        self._there = there

    def _begun_late(self) -> Bools:
        """Return a mask of running attempts that began too late to count, shape (N,)."""
        if self._limit is None:
            return np.zeros(self.num_envs, np.bool_)
        return ~begins_early(self._goal_at, self._limit)

    def _note_scenarios(self, info: dict[str, Any], began: Bools) -> None:
        """Store the infos of episodes that started."""
        if SCENARIO not in info or not began.any():
            return
        rows = [np.ravel(np.asarray(row, dtype=np.float64)) for row in info[SCENARIO][began]]
        if self.scenarios is None:
            self.scenarios = np.zeros((self.num_envs, len(rows[0])))
        self.scenarios[began] = rows

    @property
    def waiting(self) -> Bools:
        """Mask of copies that will spend the next step on their reset, shape (N,)."""
        return self._resetting

    def get_state(self) -> dict[str, Any]:
        """Return the stepper's own state (not the environment's)."""
        state = {} if self._teacher is None else self._teacher.get_state()
        return {
            **state,
            "obs": self.obs,
            "resetting": self._resetting,
            "returns": self._returns,
            "lengths": self._lengths,
            "goals": self._goals,
            "late_goals": self._late_goals,
            "goal_at": self._goal_at,
            "there": self._there,
        }

    def set_state(self, state: dict[str, Any]) -> None:
        """Restore a state that `get_state` returned.

        Raises:
            ValueError: An array has another shape than here.
        """
        shape = (self.num_envs, *(self.observation_space.shape or ()))
        self.obs = saved_array(state, "obs", np.empty(shape, self._dtype))
        self._resetting = saved_array(state, "resetting", self._resetting)
        self._returns = saved_array(state, "returns", self._returns)
        self._lengths = saved_array(state, "lengths", self._lengths)
        self._goals = saved_array(state, "goals", self._goals)
        # Earlier states have none of these.
        late = {"late_goals": 0 * self._goals} | state
        self._late_goals = saved_array(late, "late_goals", self._late_goals)
        self._goal_at = saved_array(state, "goal_at", self._goal_at)
        self._there = saved_array(state, "there", self._there)
        if self._teacher is not None:
            self._teacher.set_state(state)

    def _last(
        self, obs: Floats32, info: dict[str, Any], slots: npt.NDArray[np.intp]
    ) -> tuple[Floats32, dict[str, Any]]:
        """Return last observations of the ended episodes, and the info with their outcome."""
        if self.mode is not AutoresetMode.SAME_STEP:
            return obs[slots], info
        if "final_obs" not in info:
            raise TaskError(
                'the environment resets in the same step but gives no info["final_obs"]',
                hint="a vector environment with AutoresetMode.SAME_STEP must return it",
            )
        last = info["final_obs"][slots]
        if self.rows is not None:
            parts = {key: np.stack([each[key] for each in last]) for key in self.rows.slices}
            return self.rows.join(parts), info.get("final_info", info)
        if last.dtype == np.object_:
            last = np.stack(list(last))
        return np.asarray(last, dtype=self._dtype), info.get("final_info", info)

    def _array(self, obs: Any) -> Floats32:
        """Return observations of all copies as an own array, shape (N, ...)."""
        return np.array(obs, self._dtype) if self.rows is None else self.rows.join(obs)

    def _close_episodes(
        self, slots: npt.NDArray[np.intp], info: dict[str, Any], truncated: Bools
    ) -> Episodes:
        outcomes = {
            name: np.asarray(info[name])[slots].astype(np.bool_)
            for name in OUTCOMES
            if name in info
        }
        last = outcomes.get("is_success", np.zeros(len(slots), np.bool_))
        came = last & ~self._there[slots]
        goals = self._goals[slots] + came
        late_goals = self._late_goals[slots] + (came & self._begun_late()[slots])
        if self.rows is not None and self.rows.has_goals:
            # It has one goal, at which it shall be in the end, whatever it met on the way.
            goals, late_goals = last.astype(np.int64), np.zeros(len(slots), np.int64)
        if "goals_reached" in info:
            goals = np.asarray(info["goals_reached"])[slots].astype(np.int64)
        ended = Episodes(
            slots=slots,
            returns=self._returns[slots],
            lengths=self._lengths[slots],
            outcomes=outcomes,
            goals=goals,
            since_goal=self._lengths[slots] - self._goal_at[slots],
            truncated=truncated[slots],
            limit=self._limit,
            late_goals=late_goals,
            scenarios=None if self.scenarios is None else self.scenarios[slots],
            info=_numbers(info, slots) if self._keep_info else {},
        )
        self._forget(slots)
        return ended

    def _forget(self, slots: npt.NDArray[np.intp]) -> None:
        """Count again for the next episodes of these copies."""
        self._returns[slots] = 0.0
        self._lengths[slots] = self._goals[slots] = self._goal_at[slots] = 0
        self._late_goals[slots] = 0
        self._there[slots] = False


def _learnable(space: gym.Space[Any]) -> tuple[gym.spaces.Box, DictRows | None]:
    """Return the Box of observations to learn from, and its rows of a Dict."""
    if isinstance(space, gym.spaces.Box):
        return space, None
    if isinstance(space, gym.spaces.Dict):
        rows = DictRows(space)
        return rows.row_space, rows
    kind = type(space).__name__
    raise TaskError(f"training needs observations in a Box or a Dict of boxes, not in a {kind}")


def _numbers(info: dict[str, Any], slots: npt.NDArray[np.intp]) -> dict[str, Floats]:
    """Return the numeric entries of info for some environments, by name; shape (k,) or (k, n)."""
    found = {}
    for name, values in info.items():
        array = np.asarray(values) if not isinstance(values, dict) else np.zeros(0, np.object_)
        fits = array.dtype != np.object_ and array.ndim in (1, 2) and len(array) > slots.max()
        if not name.startswith("_") and fits and array.size <= _FEW * len(array):
            found[name] = array[slots].astype(np.float64)
    return found
