"""Shards of a task's copies, and what a worker does with those it holds."""

from __future__ import annotations

import functools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import gymnasium as gym
import numpy as np
import numpy.typing as npt

from gazelle.array_types import Bools, Floats32
from gazelle.envs.contract import PolicyContract
from gazelle.errors import TaskError
from gazelle.training.actor import Actor
from gazelle.training.copies import TaskCopies
from gazelle.training.episodes import Episodes
from gazelle.training.goal_reward import GoalReward
from gazelle.training.importing import TaskModule, load_all
from gazelle.training.rollout import Rollout, play
from gazelle.training.tasks import make_task

_LARGEST = 256
_FEWEST = 8


def divided(copies: int, unit: int = 1) -> tuple[int, ...]:
    """Return the number of copies in each shard: eight shards if possible, of 256 copies at most.

    The division depends on nothing else, so that results do not either.

    Args:
        copies: Number of copies.
        unit: Copies that cannot be apart, such as the robots of one world.

    Raises:
        TaskError: The number is not a multiple of the unit.
    """
    groups, rest = divmod(copies, unit)
    if rest or not groups:
        raise TaskError(f"--num-envs must be a multiple of {unit}, not {copies}")
    size = max(1, min(_LARGEST // unit, groups // _FEWEST))
    count = -(-groups // size)
    share, rest = divmod(groups, count)
    return tuple(unit * (share + (number < rest)) for number in range(count))


@dataclass(frozen=True, kw_only=True)
class ShardSpec:
    """All that a worker must know to make a shard."""

    task: str
    """Gymnasium id of the task."""
    sizes: tuple[int, ...]
    """Copies in each shard."""
    options: Mapping[str, Any] = field(default_factory=dict)
    """Options of the environment."""
    imports: tuple[TaskModule, ...] = ()
    """Modules that register the task."""
    reward_scale: float = 1.0
    """Rewards are multiplied by this."""
    goal_reward: GoalReward | None = None
    """Reward for the learner in place of the task's rewards."""


@dataclass(frozen=True, slots=True)
class Spaces:
    """Spaces, period and contract of a task that only workers make."""

    observation: gym.Space[Any]
    """Of one copy."""
    action: gym.Space[Any]
    """Of one copy."""
    control_period: float | None
    """Simulated seconds of a control step."""
    contract: PolicyContract
    """Contract of its policies: observations and actions."""


@dataclass(frozen=True, slots=True)
class ShardStep:
    """One control step of a shard's copies, as `TrainingStep` has it."""

    obs: Floats32
    rewards: npt.NDArray[np.float32]
    terminated: Bools
    truncated: Bools
    valid: Bools
    final_obs: Floats32 | None
    ended: Episodes | None


class Shard:
    """Some copies of a task with generators of their own.

    Args:
        blueprint: ShardSpec of the copies.
        number: Index of the blueprint's shard.
    """

    def __init__(self, blueprint: ShardSpec, number: int) -> None:
        env = make_task(blueprint.task, blueprint.sizes[number], **blueprint.options)
        self.number = number
        self.copies = TaskCopies(
            env, reward_scale=blueprint.reward_scale, goal_reward=blueprint.goal_reward
        )
        self.rng = np.random.default_rng(number)

    def reset(self, seed: int | None) -> Floats32:
        """Start all episodes again, with other chances in every shard."""
        if seed is not None:
            places, actions = np.random.SeedSequence([seed, self.number]).generate_state(2)
            self.rng = np.random.default_rng(int(actions))
            return self.copies.reset(int(places))
        return self.copies.reset()

    def collect(self, actor: Actor, steps: int) -> Rollout | None:
        """Run a policy for a given number of steps."""
        return play(self.copies, actor, steps, rng=self.rng)

    def step(self, actions: npt.NDArray[Any]) -> ShardStep:
        """Step once."""
        step = self.copies.advance(actions)
        rewards = self.copies.scaled(step)
        ends = (step.terminated, step.truncated)
        return ShardStep(step.obs, rewards, *ends, step.valid, step.final_obs, step.ended)

    def get_state(self) -> dict[str, Any] | None:
        """Return the state for `set_state`; None if the environment cannot save its state."""
        inside = self.copies.get_state()
        if inside is None:
            return None
        return {"copies": inside, "rng": self.rng.bit_generator.state}

    def set_state(self, state: Mapping[str, Any]) -> None:
        """Restore a state that `get_state` returned, also in another process."""
        self.copies.set_state(state["copies"])
        self.rng.bit_generator.state = state["rng"]


class ShardHost:
    """A worker's side: holds shards and runs requests.

    Args:
        blueprint: ShardSpec of the shards.
        numbers: Indices of its shards.
    """

    def __init__(self, blueprint: ShardSpec, numbers: Sequence[int]) -> None:
        self._blueprint = blueprint
        self._numbers = tuple(numbers)

    @functools.cached_property
    def _shards(self) -> dict[int, Shard]:
        """Made at the first request, so that errors are answers."""
        load_all(self._blueprint.imports)
        return {number: Shard(self._blueprint, number) for number in self._numbers}

    def spaces(self) -> Spaces:
        """Return the spaces, period and contract of the task."""
        copies = next(iter(self._shards.values())).copies
        env = copies.env
        return Spaces(
            copies.observation_space,
            env.single_action_space,
            copies.control_period,
            copies.contract,
        )

    def reset(self, seed: int | None) -> dict[int, tuple[Floats32, Any]]:
        """Start all episodes again; first observations and states by shard."""
        return {n: (each.reset(seed), each.get_state()) for n, each in self._shards.items()}

    def collect(self, actor: Actor, steps: int) -> dict[int, tuple[Rollout | None, Any]]:
        """Return rollouts, and the states after them, by shard."""
        return {
            n: (each.collect(actor, steps), each.get_state()) for n, each in self._shards.items()
        }

    def step(self, actions: Mapping[int, npt.NDArray[Any]]) -> dict[int, tuple[ShardStep, None]]:
        """Step once; returns the results by shard."""
        return {n: (each.step(actions[n]), None) for n, each in self._shards.items()}

    def get_state(self) -> dict[int, tuple[None, Any]]:
        """Return the states by shard."""
        return {n: (None, each.get_state()) for n, each in self._shards.items()}

    def set_state(self, states: Mapping[int, Any]) -> dict[int, tuple[None, Any]]:
        """Restore states."""
        for number, each in self._shards.items():
            each.set_state(states[number])
        return self.get_state()

    def close(self) -> None:
        """Close the environments, if they were made."""
        for each in self.__dict__.get("_shards", {}).values():
            each.copies.close()
