"""Base class of tasks over many worlds, wrapped by single and vector environments."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Any, Self

import gymnasium as gym
import numpy as np
from numpy.typing import ArrayLike, NDArray

from gazelle.argument_checks import world_indices
from gazelle.array_types import Bools, Floats, Floats32, Worlds
from gazelle.envs.autoreset import with_idle
from gazelle.envs.contract import PolicyContract, generic_contract
from gazelle.envs.floor_plan import FloorPlan
from gazelle.envs.row_checks import (
    action_array,
    checked_ends,
    checked_info,
    checked_observation,
    checked_reward,
)
from gazelle.errors import TaskError

Info = dict[str, NDArray[Any]]

_PLAIN = gym.spaces.Box, gym.spaces.Discrete

GOAL = "goal"
"""In an info: the places that `BatchedTask.goal_places` gives."""

SCENARIO = "scenario"
"""In the info of a first moment: see `BatchedTask.scenario`."""


@dataclass(
    slots=True
)  # not frozen, as that makes creation several times faster, once per control step
class Transition:
    """Result of one control step, all arrays with a leading axis over worlds.

    Attributes:
        observation: Shape (nworld, size).
        reward: Shape (nworld,).
        terminated: Whether the episode came to its end, shape (nworld,).
        truncated: Whether the episode reached its step limit, shape (nworld,).
        info: More arrays, shape (nworld, ...).
    """

    observation: Floats32
    reward: Floats
    terminated: Bools
    truncated: Bools
    info: Info


@dataclass(frozen=True, slots=True)
class FinalObservations:
    """Final observations and infos of episodes that a control step ended.

    Attributes:
        worlds: Worlds of the episodes, shape (n,).
        observation: The last ones, shape (n, size).
        info: The last info, shape (nworld, ...), zero where no episode ended.
    """

    worlds: Worlds
    observation: Floats32
    info: Info


@dataclass(frozen=True, slots=True)
class BatchStep:
    """A control step in every world, with the next episode begun where one ended.

    Attributes:
        transition: The step; observation and info are those of the next episode where
            one ended.
        final: Of the episodes that ended; None if none did.
    """

    transition: Transition
    final: FinalObservations | None


@dataclass(slots=True)
class TaskOutcome:
    """A transition before the step limit is applied; see `Transition`."""

    observation: Floats32
    reward: Floats
    terminated: Bools
    info: Info


class BatchedTask(ABC):
    """One task in ``nworld`` worlds.

    A subclass says what happens in ``_seed``, ``_begin``, ``_look``, ``_act`` and in
    ``_state`` and ``_set_state``; this class counts steps and episodes. A task that draws random
    numbers in a step also says how to take that back, in ``_hold`` and ``_release``.

    A task can be pickled and copied: it is made again with the arguments that it was made with,
    and continues from the state of ``get_state``.

    Args:
        nworld: Number of worlds.
        max_episode_steps: Control steps until an episode is truncated; None for no limit.

    Attributes:
        observation_space: Of one world.
        action_space: Of one world.
        control_period: Simulated time of one control step [s].
        scenario_names: Names of the numbers of `scenario`, such as ``start_x``.
        floor_plan: Plan of the world, seen from above; None if unknown.
        elapsed: Control steps of the current episode, shape (nworld,).
    """

    observation_space: gym.spaces.Box
    action_space: gym.Space[Any]
    control_period: float
    scenario_names: tuple[str, ...] = ()
    floor_plan: FloorPlan | None = None

    _made_with: tuple[tuple[Any, ...], dict[str, Any]]

    def __new__(cls, *arguments: Any, **options: Any) -> Self:
        """Store the arguments of the task, for pickling."""
        task = super().__new__(cls)
        task._made_with = (arguments, options)
        return task

    def __reduce__(self) -> tuple[Any, ...]:
        """Return the constructor's arguments and the state, for pickling."""
        return _rebuilt, (type(self), *self._made_with), self.get_state()

    def __setstate__(self, state: dict[str, Any]) -> None:
        """Restore the state of a pickle or a copy."""
        self.set_state(state)

    def __init__(self, nworld: int, max_episode_steps: int | None) -> None:
        self.nworld = nworld
        self.max_episode_steps = max_episode_steps
        self.elapsed = np.zeros(nworld, dtype=np.int64)
        self._known_goals: Floats | None = None

    @property
    def goal_places(self) -> Floats | None:
        """Goals of the running episodes in the world frame [m], shape (nworld, 2 or 3), to draw them.

        By default the info's ``goal``; None before the first episode, and of a task
        without such an entry.
        """
        return self._known_goals

    @property
    def row_space(self) -> gym.spaces.Box:
        """Space of one world's row in `Transition.observation`."""
        return self.observation_space

    @property
    def contract(self) -> PolicyContract:
        """Contract of its policies; a task that knows more than its spaces overrides this."""
        return generic_contract(self.observation_space, self.action_space, self.control_period)

    def seed(self, seed: int) -> None:
        """Start all random numbers over, as in a task just made with this seed."""
        self._seed(seed)

    def begin(self, worlds: Worlds) -> tuple[Floats32, Info]:
        """Start new episodes.

        Args:
            worlds: Indices of the worlds, shape (n,).

        Returns:
            First observations, shape (n, size), and their info.
        """
        worlds = world_indices(worlds, self.nworld, TaskError)
        self.elapsed[worlds] = 0
        self._begin(worlds)
        seen, found = self._look(worlds)
        observation = checked_observation(seen, len(worlds), self.row_space.shape)
        info = checked_info(found, len(worlds))
        self._note_goals(info, worlds)
        if self.max_episode_steps is not None:
            info["is_timeout"] = np.zeros(len(worlds), dtype=np.bool_)
        scenario = self.scenario(worlds)
        if scenario is not None:
            info[SCENARIO] = scenario
        return observation, info

    def scenario(self, worlds: Worlds) -> Floats | None:
        """Return the numbers that distinguish the episodes beginning in these worlds, shape (n, size).

        All that was drawn for them: where the robot starts, its goal, how obstacles stand. Two
        episodes with equal numbers are the same one, which evaluations count once; noise does not
        belong here. None, the default, if unknown.
        """
        del worlds
        return None

    def advance(self, actions: ArrayLike) -> Transition:
        """Advance every world by one control step; nothing is reset.

        Args:
            actions: Shape (nworld, ...).

        Raises:
            TaskError: The actions have the wrong shape or values, or what the task returns has.
        """
        plain = isinstance(self.action_space, _PLAIN)
        outcome = self._act(action_array(actions) if plain else actions)
        nworld = self.nworld
        observation = checked_observation(outcome.observation, nworld, self.row_space.shape)
        reward = checked_reward(outcome.reward, nworld)
        terminated = checked_ends("terminated", outcome.terminated, nworld)
        info = checked_info(outcome.info, nworld)
        self._note_goals(info)
        self.elapsed += 1
        if self.max_episode_steps is None:
            truncated = np.zeros(nworld, dtype=np.bool_)
        else:
            truncated = self.elapsed >= self.max_episode_steps
            info["is_timeout"] = truncated > terminated
        return Transition(observation, reward, terminated, truncated, info)

    def step(self, actions: ArrayLike) -> BatchStep:
        """Advance every world by one control step, and start the next episode where one ended.

        Args:
            actions: Shape (nworld, ...).

        Raises:
            TaskError: The actions have the wrong shape or values.
        """
        last = self.advance(actions)
        done = last.terminated | last.truncated
        if not np.count_nonzero(done):
            return BatchStep(last, None)
        worlds = np.flatnonzero(done)
        observation = last.observation.copy()
        first, start = self.begin(worlds)
        observation[worlds] = first
        info = _put(last.info, start, worlds)
        final = FinalObservations(
            worlds,
            last.observation.take(worlds, axis=0),
            {name: _only(values, worlds) for name, values in last.info.items()},
        )
        now = Transition(observation, last.reward, last.terminated, last.truncated, info)
        return BatchStep(now, final)

    def advance_or_begin(self, actions: ArrayLike, over: Worlds) -> Transition:
        """Advance some worlds by one control step, and start the next episode in the others.

        Args:
            actions: Shape (nworld, ...); those of worlds that begin are not looked at.
            over: Worlds with their episode over, shape (n,).

        Returns:
            The transition; where an episode began the first observation and info, a reward of 0,
            and no end.

        Raises:
            TaskError: The actions have the wrong shape or values.
        """
        over = world_indices(over, self.nworld, TaskError)
        if not len(over):
            return self.advance(actions)
        kept = self._hold(over)
        last = self.advance(with_idle(actions, self.action_space, over))
        self._release(over, kept)
        first, start = self.begin(over)
        observation, reward = last.observation.copy(), last.reward.copy()
        terminated, truncated = last.terminated.copy(), last.truncated.copy()
        observation[over], reward[over] = first, 0.0
        terminated[over] = truncated[over] = False
        return Transition(observation, reward, terminated, truncated, _put(last.info, start, over))

    def _note_goals(self, info: Info, worlds: Worlds | None = None) -> None:
        """Store the goals of these worlds, all if None, for `goal_places`."""
        goals = info.get(GOAL)
        if goals is None or goals.ndim != 2 or goals.shape[1] not in (2, 3):
            return
        if worlds is None:
            self._known_goals = goals
            return
        whole = np.zeros((self.nworld, goals.shape[1]))
        if self._known_goals is not None:
            whole[:] = self._known_goals
        whole[worlds] = goals
        self._known_goals = whole

    def get_state(self) -> dict[str, Any]:
        """Return the whole state as a dict of arrays and bytes.

        Simulation and random numbers are included.
        """
        return {"elapsed": self.elapsed.copy(), **self._state()}

    def set_state(self, state: dict[str, Any]) -> None:
        """Restore what ``get_state`` returned.

        Raises:
            TaskError: The state is of another task or number of worlds.
        """
        try:
            elapsed = np.asarray(state["elapsed"], dtype=np.int64)
            if elapsed.shape != (self.nworld,):
                raise TaskError(
                    f"the state is of {elapsed.size} worlds, and this task has {self.nworld}"
                )
            self._set_state(state)
        except KeyError as error:
            raise TaskError(f"this is not a state of this task: there is no {error}") from error
        except (TypeError, ValueError, IndexError, OverflowError) as error:
            raise TaskError(f"this is not a state of this task: {error}") from error
        self.elapsed[:] = elapsed

    def _hold(self, worlds: Worlds) -> Any:
        """Save the state of worlds that the next step must not change, although they take part in it.

        Their episode is over, and the next begins after that step, in which they should do as if it
        did not happen: random numbers stay undrawn, and nothing gets in the way of others.
        """
        del worlds

    def _release(self, worlds: Worlds, kept: Any) -> None:
        """Restore what ``_hold`` returned."""
        del worlds, kept

    @abstractmethod
    def render(self, world: int) -> NDArray[np.uint8]:
        """Return a picture of one world, shape (height, width, 3)."""

    @abstractmethod
    def close(self) -> None:
        """Free the task's resources; a second call does nothing."""

    @abstractmethod
    def _seed(self, seed: int) -> None:
        """Start all random numbers over."""

    @abstractmethod
    def _begin(self, worlds: Worlds) -> None:
        """Set these worlds to the start of a new episode."""

    @abstractmethod
    def _look(self, worlds: Worlds) -> tuple[Floats32, Info]:
        """Return observation, shape (n, size), and info of these worlds at their start."""

    @abstractmethod
    def _act(self, actions: ArrayLike) -> TaskOutcome:
        """Advance by one control step."""

    @abstractmethod
    def _state(self) -> dict[str, Any]:
        """Return the subclass's part of ``get_state``."""

    @abstractmethod
    def _set_state(self, state: dict[str, Any]) -> None:
        """Restore what ``_state`` returned."""


def _put(info: Info, start: Info, worlds: Worlds) -> Info:
    """Return the info with that of some worlds' new episodes in its place."""
    merged = dict(info)
    nworld = len(next(iter(info.values()))) if info else 0
    for name, values in start.items():
        # Info that only some worlds have, such as the scenario after a reset, is zero elsewhere.
        known = name in info
        whole = info[name].copy() if known else np.zeros((nworld, *values.shape[1:]), values.dtype)
        whole[worlds] = values
        merged[name] = whole
    return merged


def _rebuilt(
    kind: type[BatchedTask], arguments: tuple[Any, ...], options: dict[str, Any]
) -> BatchedTask:
    """Return a task as it was made."""
    return kind(*arguments, **options)


def _only(values: NDArray[Any], worlds: Worlds) -> NDArray[Any]:
    """Return the values of some worlds, and zeros elsewhere."""
    kept = np.zeros(values.shape, values.dtype)
    kept[worlds] = values.take(worlds, axis=0)  # several times as fast as indexing
    return kept
