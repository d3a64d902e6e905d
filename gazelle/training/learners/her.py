"""Hindsight experience replay: relabels transitions with achieved goals.

M. Andrychowicz et al., "Hindsight Experience Replay" (NIPS 2017, arXiv 1707.01495), with goals
from the future of the same episode. Why this is not Stable-Baselines3's class is documented in
docs/explanation/decisions/012-own-learners.md.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from gazelle.training.goal_replay import GoalReplay
from gazelle.training.learners.replay import MaskedReplayBuffer

_RUNNING = -1
_ROUNDS = 2  # in which steps are drawn again


class HindsightReplayBuffer(MaskedReplayBuffer):
    """A replay memory that gives a share of its transitions a goal that was reached later.

    Later means after the same step or another of the same episode; of one that still runs, so far.
    Each step is a row of the memory for all copies, and only the oldest rows are overwritten, so
    whatever came later is still there.

    Args:
        args: As Stable-Baselines3's ``ReplayBuffer`` takes them.
        goals: Places of goals in observations, and their rewards.
        share: Of transitions that get another goal, in [0, 1].
        redraw: Share of these that is drawn again where that goal was reached before the step
            already, in [0, 1] (O. Manela and A. Biess, "Bias-reduced hindsight experience replay
            with virtual goal prioritization", 2019, arXiv 1905.05498, leave all of them out).
        reward_scale: Rewards are multiplied by this.
        kwargs: As there.
    """

    def __init__(
        self,
        *args: Any,
        goals: GoalReplay,
        share: float,
        redraw: float = 0.0,
        reward_scale: float = 1.0,
        **kwargs: Any,
    ) -> None:
        super().__init__(*args, **kwargs)
        self._goals, self._share, self._reward_scale = goals, share, reward_scale
        self._redraw = redraw
        shape = self.buffer_size, self.n_envs
        self.episodes = np.zeros(shape, np.int64)
        """The number of the episode of each transition, counted in its copy, modulo the rows."""
        self.ends = np.full(shape, _RUNNING, np.int64)
        """The step after the last one of each episode, by that number and copy."""
        self.current = np.zeros(self.n_envs, np.int64)

    def add(
        self,
        obs: npt.NDArray[Any],
        next_obs: npt.NDArray[Any],
        action: npt.NDArray[Any],
        reward: npt.NDArray[Any],
        done: npt.NDArray[Any],
        infos: list[dict[str, Any]],
    ) -> None:
        """Add one control step of all copies."""
        self.episodes[self.pos] = self.current
        super().add(obs, next_obs, action, reward, done, infos)
        over = np.flatnonzero(done)
        self.ends[self.current[over], over] = self.steps
        # An episode has a row at least, so a number comes back only after all its rows are gone.
        self.current[over] = (self.current[over] + 1) % self.buffer_size
        self.ends[self.current[over], over] = _RUNNING

    def get_state(self) -> dict[str, Any]:
        """Return the memory as arrays, only as far as it is filled."""
        return super().get_state() | {"ends": self.ends, "current": self.current}

    def set_state(self, state: dict[str, Any]) -> None:
        """Restore a memory that `get_state` returned."""
        super().set_state(state)
        self.ends[:], self.current[:] = state["ends"], state["current"]

    def _names(self) -> list[str]:
        return [*super()._names(), "episodes"]

    def _parts(
        self, rows: npt.NDArray[np.intp], slots: npt.NDArray[np.intp]
    ) -> dict[str, npt.NDArray[Any]]:
        """Return transitions at the given rows and slots, the first of them with other goals."""
        count = round(self._share * len(rows))
        if not count:
            return super()._parts(rows, slots)
        later = self._later(rows[:count], slots[:count])
        if self._redraw:
            self._draw_again(rows[:count], slots[:count], later)
        goals = self._achieved(later, slots[:count])

        def rewards_at(at: npt.NDArray[np.intp]) -> npt.NDArray[np.float32]:
            rewards: npt.NDArray[np.float32] = self.rewards[at, slots]
            rewards[:count] = self._rewards(at[:count], slots[:count], goals)
            return rewards

        parts = self._transitions(rows, slots, rewards_at)
        for name in ("observations", "next_observations"):
            parts[name][:count, self._goals.desired] = goals
        return parts

    def _rewards(
        self,
        rows: npt.NDArray[np.intp],
        slots: npt.NDArray[np.intp],
        goals: npt.NDArray[Any],
    ) -> npt.NDArray[np.float32]:
        """Return the rewards of steps with other goals, shape (n,)."""
        rewards = self._goals.rewards(self._achieved(rows, slots), goals)
        return np.asarray(rewards * np.float32(self._reward_scale), np.float32)

    def _draw_again(
        self,
        rows: npt.NDArray[np.intp],
        slots: npt.NDArray[np.intp],
        later: npt.NDArray[np.intp],
    ) -> None:
        """Resample, in place, most of the steps with goals reached before them."""
        looked_at = np.arange(len(rows))
        for _ in range(_ROUNDS):
            at, of = rows[looked_at], slots[looked_at]
            goals = self._achieved(later[looked_at], of)
            before = self.observations[at, of][:, self._goals.achieved]
            best = self._goals.rewards(goals, goals)
            idle = looked_at[self._goals.rewards(before, goals) >= best]
            chances = np.random.random_sample(len(idle))  # noqa: NPY002  # as the parent draws
            looked_at = idle[chances < self._redraw]
            if not len(looked_at):
                return
            rows[looked_at], slots[looked_at] = self._draw(len(looked_at))
            later[looked_at] = self._later(rows[looked_at], slots[looked_at])

    def _achieved(
        self, rows: npt.NDArray[np.intp], slots: npt.NDArray[np.intp]
    ) -> npt.NDArray[Any]:
        """Return the goals that were achieved by these steps, shape (n, entries)."""
        reached: npt.NDArray[Any] = self.next_observations[rows, slots][:, self._goals.achieved]
        return reached

    def _later(
        self, rows: npt.NDArray[np.intp], slots: npt.NDArray[np.intp]
    ) -> npt.NDArray[np.intp]:
        """Return rows of the same episodes, the given ones or later."""
        ends = self.ends[self.episodes[rows, slots], slots]
        ends = np.where(ends == _RUNNING, self.steps, ends)
        # How many rows ago: the newest is the one before the next to be written.
        ages = (self.pos - 1 - rows) % self.buffer_size
        now = self.steps - 1 - ages
        draws = np.random.random_sample(len(rows))  # noqa: NPY002  # as the parent draws
        ahead = (draws * (ends - now)).astype(np.intp)
        later: npt.NDArray[np.intp] = (rows + ahead) % self.buffer_size
        return later
