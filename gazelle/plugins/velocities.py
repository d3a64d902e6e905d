"""Velocities out of the blue: ``libRandomVelocityPlugin.so`` and ``libInitialVelocityPlugin.so``."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, Worlds
from gazelle.description import Parameters
from gazelle.errors import SimulationError
from gazelle.simulation import ModelPlugin, Robot
from gazelle.streams import Stream

_FAR = 1e16


class RandomVelocity(ModelPlugin):
    """Gives a link a velocity at every step, and draws another from time to time.

    The first is ``initial_velocity``; later ones are drawn evenly from -1 to 1 on each axis, as
    directions, and made ``velocity_factor`` long.
    """

    update_rate = 0.0

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags, find the link."""
        self._clock = robot.simulation.clock
        self._link = robot.links[parameters.require("link", str)]
        nworld = robot.simulation.nworld
        self._first = np.asarray(parameters.numbers("initial_velocity", (0.0, 0.0, 0.0)))
        self._velocity: Floats = np.tile(self._first, (nworld, 1))
        self._factor = parameters.get("velocity_factor", 1.0)
        self._period = parameters.get("update_period", 10.0)
        self._least, self._most = (
            np.array([parameters.get(f"{end}_{axis}", far) for axis in "xyz"])
            for end, far in (("min", -_FAR), ("max", _FAR))
        )
        if (self._least > self._most).any():
            raise SimulationError(
                "a minimum velocity is above the maximum", source=parameters.source
            )
        name = f"{self._link.name}::random_velocity"
        self._stream = Stream(robot.simulation.seed, name, nworld)
        self._drawn: Floats = np.full(nworld, robot.simulation.time)

    def on_update(self, time: float) -> None:
        """Move."""
        worlds = np.flatnonzero(time - self._drawn >= self._period)
        if worlds.size:
            direction = 2.0 * self._stream.uniform(3, worlds) - 1.0
            direction /= np.linalg.norm(direction, axis=1, keepdims=True)
            self._velocity[worlds] = direction * self._factor
            self._drawn[worlds] = time
        self._velocity = np.clip(self._velocity, self._least, self._most)
        self._link.set_twist(self._velocity, self._link.motion().angular)

    def reseed(self, seed: int, worlds: Worlds | None) -> None:
        """Set the seed of the random numbers."""
        self._stream.reseed(seed, worlds)

    def reset(self, worlds: Worlds | None) -> None:
        """Start with the first velocity."""
        rows = slice(None) if worlds is None else worlds
        self._velocity[rows], self._drawn[rows] = self._first, self._clock.now
        if worlds is None:
            self._stream.rewind()

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Return velocities, when they were drawn, and the random numbers."""
        return {
            "velocity": self._velocity.copy(),
            "drawn": self._drawn.copy(),
            "keys": self._stream.keys.copy(),
            "counters": self._stream.counters.copy(),
        }

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        self._velocity[:], self._drawn[:] = state["velocity"], state["drawn"]
        self._stream.keys[:], self._stream.counters[:] = state["keys"], state["counters"]


class InitialVelocity(ModelPlugin):
    """Starts a model with a velocity: in the world frame, at the start and after each reset."""

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags and push."""
        self._robot = robot
        self._linear = parameters.numbers("linear", (0.0, 0.0, 0.0))
        self._angular = parameters.numbers("angular", (0.0, 0.0, 0.0))
        self.reset(None)

    def reset(self, worlds: Worlds | None) -> None:
        """Set the initial velocities again."""
        self._robot.set_twist(self._linear, self._angular, worlds)
