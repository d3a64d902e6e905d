"""Base class of tasks in a simulation; a subclass defines observations, actions and rewards."""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import gymnasium as gym
import numpy as np
from numpy.typing import ArrayLike, NDArray

from gazelle.argument_checks import checked, world_indices
from gazelle.array_types import Bools, Floats, Floats32, Worlds
from gazelle.description import World
from gazelle.envs.batched_task import BatchedTask, Info, TaskOutcome
from gazelle.envs.limits import MAX_DRAWS
from gazelle.envs.options import TaskSettings, check_integer
from gazelle.envs.row_checks import checked_observation
from gazelle.errors import TaskError
from gazelle.sensors import View, look_at
from gazelle.simulation import Simulation
from gazelle.streams import Stream

_VIEW = View(look_at((3.0, -3.0, 2.0), (0.0, 0.0, 0.5)), width=480, height=400, samples=1)
_CLOSE = 1e-9


@dataclass(frozen=True, slots=True)
class StepOutcome:
    """Outcome of a control step; arrays over worlds.

    Attributes:
        reward: Finite, shape (nworld,).
        terminated: Whether the episode came to its end, bools, shape (nworld,).
        info: More arrays, shape (nworld, ...), such as ``is_success``.
    """

    reward: Floats
    terminated: Bools
    info: Info = field(default_factory=dict)


class SimulationTask(BatchedTask):
    """One task in all worlds of a simulation, which it owns.

    A subclass sets ``observation_space`` and ``action_space`` and says what happens in `start`,
    `observe`, `act` and `outcome`, all on arrays over worlds; resets, seeds, saved states, pickles
    and pictures come with this class.

    Args:
        simulation: Simulation, as at the start of every episode.
        control_period: Simulated time of a control step [s], a multiple of the physics step.
        max_episode_steps: Control steps until an episode is truncated; None for no limit.

    Raises:
        TaskError: The control period is not a multiple of the physics step.

    Attributes:
        simulation: Simulation.
        memory: Arrays that the task keeps between steps, by name; they are saved with it.
        view: From where pictures are taken.
    """

    view: View = _VIEW

    def __init__(
        self,
        simulation: Simulation,
        *,
        control_period: float,
        max_episode_steps: int | None = None,
    ) -> None:
        super().__init__(simulation.nworld, max_episode_steps)
        step = simulation.engine.time_step
        if (
            control_period < step
            or abs(round(control_period / step) * step - control_period) > _CLOSE
        ):
            raise TaskError(
                f"control_period {control_period} s is not a multiple of the step {step} s"
            )
        self.simulation = simulation
        self.control_period = control_period
        self.memory: dict[str, NDArray[Any]] = {}
        self._stream = Stream(simulation.seed, type(self).__name__, simulation.nworld)

    def start(self, worlds: Worlds) -> None:
        """Change the initial state of an episode, after these worlds were reset; shape (n,)."""

    @abstractmethod
    def observe(self, worlds: Worlds | None) -> NDArray[Any]:
        """Return the observation in these worlds (all if None), shape (n, ...) as ``observation_space``.

        It becomes what that space holds: float32 of numbers, uint8 of pictures (`CameraObservation`).
        """

    @abstractmethod
    def act(self, actions: NDArray[Any]) -> None:
        """Command what the control step does; int64 of shape (nworld,), or float64 of (nworld, n)."""

    @abstractmethod
    def outcome(self, observation: Any) -> StepOutcome:
        """Return the outcome of the step, given the observation after it, shape (nworld, ...)."""

    @checked(TaskError)
    def draw(self, low: float, high: float, worlds: Worlds, count: int = 1) -> Floats:
        """Return random numbers for these worlds, shape (n, count): worlds are independent.

        Raises:
            TaskError: There is no such world, or a number is invalid.
        """
        check_integer("count", count, 0, MAX_DRAWS)
        return low + (high - low) * self._stream.uniform(
            count, world_indices(worlds, self.nworld, TaskError)
        )

    @property
    def lasting(self) -> Bools:
        """True where the running control step is the last of its episode's time, shape (nworld,)."""
        if self.max_episode_steps is None:
            return np.zeros(self.nworld, np.bool_)
        return self.elapsed + 1 >= self.max_episode_steps

    def render(self, world: int) -> NDArray[np.uint8]:
        """Return a picture of one world from ``view``."""
        return self.simulation.render(self.view, world)

    def close(self) -> None:
        """Free the simulation; a second call does nothing."""
        self.simulation.close()

    def _seed(self, seed: int) -> None:
        self.simulation.reset(seed=seed)
        self._stream = Stream(seed, type(self).__name__, self.nworld)

    def _begin(self, worlds: Worlds) -> None:
        self.simulation.reset(worlds)
        self.start(worlds)

    def _look(self, worlds: Worlds) -> tuple[Floats32, Info]:
        return self._seen(worlds), {}

    def _act(self, actions: ArrayLike) -> TaskOutcome:
        self.act(checked_actions(actions, self.action_space, self.nworld))
        self.simulation.run(self.control_period)
        observation = self._seen(None)
        came = self.outcome(observation)
        return TaskOutcome(observation, came.reward, came.terminated, dict(came.info))

    def _seen(self, worlds: Worlds | None) -> Any:
        count = self.nworld if worlds is None else len(worlds)
        seen = checked_observation(self.observe(worlds), count, self.observation_space.shape)
        return seen.astype(self.observation_space.dtype, copy=False)

    def _hold(self, worlds: Worlds) -> Any:
        return self._stream.counters[worlds], {
            name: array[worlds].copy() for name, array in self.memory.items()
        }

    def _release(self, worlds: Worlds, kept: Any) -> None:
        self._stream.counters[worlds], memory = kept
        for name, rows in memory.items():
            self.memory[name][worlds] = rows

    def _state(self) -> dict[str, Any]:
        return {
            "simulation": self.simulation.snapshot(),
            "draws": self._stream.counters.copy(),
            "keys": self._stream.keys.copy(),
            **{f"memory/{name}": array.copy() for name, array in self.memory.items()},
        }

    def _set_state(self, state: dict[str, Any]) -> None:
        self.simulation.restore(bytes(state["simulation"]))
        self._stream.keys[:], self._stream.counters[:] = state["keys"], state["draws"]
        for name, array in self.memory.items():
            array[:] = state[f"memory/{name}"]


def simulation_of(
    world: World | str | Path, nworld: int, settings: TaskSettings, time_step: float | None
) -> Simulation:
    """Create the simulation of a task, with the user's settings.

    Args:
        world: World with the obstacles.
        nworld: Number of worlds.
        settings: Options of the user.
        time_step: The task's own physics step [s]; None for the world's.
    """
    return Simulation(
        world,
        settings.engine,
        nworld=nworld,
        seed=settings.seed or 0,
        time_step=settings.time_step or time_step,
        threads=settings.threads,
    )


def checked_actions(actions: ArrayLike, space: gym.Space[Any], nworld: int) -> NDArray[Any]:
    """Return actions of all worlds as an array.

    Raises:
        TaskError: They have the wrong shape or values.
    """
    rows = np.asarray(actions)
    if isinstance(space, gym.spaces.Discrete):
        first, last = int(space.start), int(space.start + space.n) - 1
        whole = np.issubdtype(rows.dtype, np.integer) and rows.shape == (nworld,)
        if not whole or rows.min(initial=first) < first or rows.max(initial=last) > last:
            raise TaskError(
                f"actions must be {nworld} ints from {first} to {last}, "
                f"not {rows.dtype} of shape {rows.shape}: {rows!r}"[:200]
            )
        return rows.astype(np.int64)
    shape = (nworld, *(space.shape or ()))
    values = rows.astype(np.float64)
    if rows.shape != shape or np.count_nonzero(np.isfinite(values)) < values.size:
        raise TaskError(f"actions must be finite, of shape {shape}, not {rows.shape}")
    return values
