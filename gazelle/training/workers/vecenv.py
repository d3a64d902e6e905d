"""Copies of a task in other processes or on other machines, for Stable-Baselines3."""

from __future__ import annotations

import functools
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from gazelle.array_types import Bools, Floats32
from gazelle.training.actor import Actor
from gazelle.training.copies import TaskCopies
from gazelle.training.episodes import Episodes
from gazelle.training.goal_replay import GoalReplay
from gazelle.training.picture_layers import observation_dtype
from gazelle.training.rollout import Rollout, join
from gazelle.training.shared_vecenv import SharedVecEnv
from gazelle.training.workers.shards import ShardStep
from gazelle.training.workers.team import WorkerGroup


class WorkerVecEnv(SharedVecEnv):
    """All copies of a task that a team of workers holds.

    Learners that can, such as `FastPPO`, have whole rollouts played by the workers (`collect`);
    others go step by step, which suits tasks that are slow themselves: a real simulator, a robot.

    Args:
        team: The workers.
        sizes: Copies in each shard.
        on_episodes: Called with the episodes that ended.
        copy: Makes as few copies as can be here, for what needs no step.

    Attributes:
        obs: Next observations, shape (N, ...).
        starts: Mask of copies that begin an episode with it, shape (N,).
        control_period: Simulated seconds of a control step; None if unknown.
        contract: Contract of the task's policies.
    """

    def __init__(
        self,
        team: WorkerGroup,
        sizes: Sequence[int],
        *,
        on_episodes: Callable[[Episodes], None] | None = None,
        copy: Callable[[], TaskCopies] | None = None,
    ) -> None:
        self.team = team
        self._copy = copy
        self.on_episodes = on_episodes
        self._on_observations: Callable[[Floats32], None] | None = None
        self._ends = np.cumsum(sizes)[:-1]
        spaces = team.spaces()
        self.control_period = spaces.control_period
        self.contract = spaces.contract
        super().__init__(sum(sizes), spaces.observation, spaces.action)
        self.obs: Floats32 = np.zeros(
            (self.num_envs, *(spaces.observation.shape or ())),
            observation_dtype(spaces.observation),
        )
        self.starts: Bools = np.ones(self.num_envs, np.bool_)

    @functools.cached_property
    def goal_replay(self) -> GoalReplay | None:
        """See `TaskCopies.goal_replay`: rewards are worked out here, by a copy that never steps."""
        return None if self._own_copy is None else self._own_copy.goal_replay

    @functools.cached_property
    def _own_copy(self) -> TaskCopies | None:
        return None if self._copy is None else self._copy()

    def watch(self, on_observations: Callable[[Floats32], None]) -> None:
        """Call a function with the observations after each step, shape (N, ...)."""
        self._on_observations = on_observations

    def reset(self) -> Floats32:
        """Start all episodes again, with the seed given to `seed` if there is one."""
        self.obs = np.concatenate(list(self.team.call("reset", self._seed).values()))
        self.starts = np.ones(self.num_envs, np.bool_)
        self._seed = None
        return self.obs

    def collect(
        self,
        actor: Actor,
        steps: int,
        *,
        rng: np.random.Generator,
        on_step: Callable[[], bool] | None = None,
    ) -> Rollout | None:
        """Run a policy on the workers, see `rollout.play`; they sample actions themselves."""
        del rng
        met = join(list(self.team.call("collect", actor, steps).values()))
        self.obs, self.starts = met.last_obs, met.last_starts
        if self.on_episodes is not None:
            for _, ended in met.ended:
                self.on_episodes(ended)
        for row in range(1, steps + 1):
            if self._on_observations is not None:
                self._on_observations(met.observations[row] if row < steps else met.last_obs)
            if on_step is not None and not on_step():
                return None
        return met

    def step_wait(self) -> tuple[Floats32, Floats32, Bools, list[dict[str, Any]]]:
        """Step; returns observations, rewards, dones, infos."""
        parts = dict(enumerate(np.split(self._actions, self._ends)))
        answers = self.team.call("step", parts).values()
        before = np.split(self.obs, self._ends)
        steps = [
            each if isinstance(each, ShardStep) else _cut_off(last, each)
            for last, each in zip(before, answers, strict=True)
        ]
        infos: list[dict[str, Any]] = [{} for _ in range(self.num_envs)]
        for step, shift in zip(steps, [0, *self._ends], strict=True):
            self._fill_infos(step, int(shift), infos)
        self.obs = np.concatenate([step.obs for step in steps])
        self.starts = np.concatenate([step.terminated | step.truncated for step in steps])
        if self._on_observations is not None:
            self._on_observations(self.obs)
        rewards = np.concatenate([step.rewards for step in steps])
        return self.obs, rewards, self.starts, infos

    def _fill_infos(self, step: ShardStep, shift: int, infos: list[dict[str, Any]]) -> None:
        """Fill infos of one shard's copies, as Stable-Baselines3 defines them."""
        if step.ended is not None and self.on_episodes is not None:
            self.on_episodes(step.ended.moved(shift))
        if step.final_obs is not None:
            slots = np.flatnonzero(step.terminated | step.truncated)
            for slot, last in zip(slots, step.final_obs, strict=True):
                cut = bool(step.truncated[slot])
                infos[shift + slot] = {"terminal_observation": last, "TimeLimit.truncated": cut}
        for slot in np.flatnonzero(~step.valid):
            infos[shift + slot]["reset_step"] = True

    def get_state(self) -> dict[str, Any] | None:
        """Return the state that `set_state` restores; None if the task cannot save it."""
        self.team.call("get_state")
        states = self.team.states
        if states is None:
            return None
        shards = [states[number] for number in sorted(states)]
        return {"shards": shards, "obs": self.obs, "starts": self.starts}

    def set_state(self, state: dict[str, Any]) -> None:
        """Restore a state that `get_state` returned, whatever the number of workers then."""
        self.team.call("set_state", dict(enumerate(state["shards"])))
        self.obs = np.array(state["obs"], observation_dtype(self.observation_space))
        self.starts = np.array(state["starts"], np.bool_)

    def close(self) -> None:
        """Stop the workers."""
        self.team.close()
        own = self.__dict__.get("_own_copy")
        if own is not None:
            own.close()


def _cut_off(last: Floats32, first: Floats32) -> ShardStep:
    """Return the step in which a worker was lost: its episodes are cut off where they were."""
    copies = len(last)
    nothing, all_of_them = np.zeros(copies, np.bool_), np.ones(copies, np.bool_)
    rewards = np.zeros(copies, np.float32)
    return ShardStep(first, rewards, nothing, all_of_them, all_of_them, last, None)
