"""Commands that a drone follows inaccurately: the noise of SJTU's quadrotor."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gazelle.array_types import Floats, Worlds
from gazelle.description import Parameters
from gazelle.engines.limits import NANOSECONDS
from gazelle.simulation import Clock, TwistInput
from gazelle.simulation.state_lock import between_steps
from gazelle.streams import Stream

# Upwards, and about x, y and z.
_AXES = 4


class DroneCommands(TwistInput):
    """Velocity commands with noise: on the velocity upwards and on all about the axes.

    Each command gets fresh numbers; others drift along, and are drawn again at the first command
    ``motionDriftNoiseTime`` after the last time. What was once drawn holds until the next command.

    Args:
        nworld: Number of worlds.
        topic: Topic name.
        parameters: Tags of the plugin.
        clock: Knows the time.
        seed: Of the run.
        name: Of the random numbers.
    """

    def __init__(
        self, nworld: int, topic: str, parameters: Parameters, clock: Clock, seed: int, name: str
    ) -> None:
        super().__init__(nworld, topic)
        self._clock = clock
        self._small = parameters.get("motionSmallNoise", 0.0)
        self._drift = parameters.get("motionDriftNoise", 0.0)
        self._drift_time = parameters.get("motionDriftNoiseTime", 1.0)
        self._stream = Stream(seed, f"{name}::motion", nworld)
        self._drifts: Floats = np.zeros((nworld, _AXES))
        # Since the drift was drawn, counted from command to command [s]; and the last command [ns].
        self._age: Floats = np.zeros(nworld)
        self._received_ns = np.full(nworld, -1, np.int64)

    @between_steps
    def send(
        self,
        linear: ArrayLike = 0.0,
        angular: ArrayLike = 0.0,
        worlds: Worlds | None = None,
    ) -> None:
        """Command a velocity; see `TwistInput.send`."""
        super().send(linear, angular, worlds)
        if not (self._small or self._drift):
            return
        every = np.arange(len(self.linear))
        rows = every if worlds is None else every[worlds]
        noise = self._drawn(rows)
        self.linear[rows, 2] += noise[:, 0]
        self.angular[rows] += noise[:, 1:]

    def _drawn(self, rows: Worlds) -> Floats:
        """Return noise of a command in some worlds, shape (n, 4)."""
        drawn = 2.0 * self._stream.uniform(2 * _AXES, rows) - 1.0
        old = self._age[rows] > self._drift_time
        self._drifts[rows[old]] = self._drift * drawn[old, _AXES:]
        self._age[rows[old]] = 0.0
        now_ns, received = self._clock.now_ns, self._received_ns[rows]
        self._age[rows] += np.where(received < 0, 0, now_ns - received) / NANOSECONDS
        self._received_ns[rows] = now_ns
        noise: Floats = self._drifts[rows] + self._small * drawn[:, :_AXES]
        return noise

    def reseed(self, seed: int, worlds: Worlds | None) -> None:
        """Set the seed of the random numbers."""
        self._stream.reseed(seed, worlds)

    def reset(self, worlds: Worlds | None) -> None:
        """Discard the drift; for all worlds, also the count of random numbers."""
        rows = slice(None) if worlds is None else worlds
        self._drifts[rows], self._age[rows], self._received_ns[rows] = 0.0, 0.0, -1
        if worlds is None:
            self._stream.rewind()

    def state(self) -> dict[str, NDArray[np.generic]]:
        """Return drifts and random numbers; the commands themselves are the port's."""
        return {
            "drifts": self._drifts.copy(),
            "age": self._age.copy(),
            "received": self._received_ns.copy(),
            "keys": self._stream.keys.copy(),
            "counters": self._stream.counters.copy(),
        }

    def restore(self, state: dict[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        self._drifts[:], self._age[:] = state["drifts"], state["age"]
        self._received_ns[:] = state["received"]
        self._stream.keys[:], self._stream.counters[:] = state["keys"], state["counters"]
