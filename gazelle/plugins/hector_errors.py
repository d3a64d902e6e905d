"""Error model of Hector's sensors: offset, drift, noise and scale.

Drift is a first-order Gauss-Markov process: it begins at ``N(0, drift)``, and at every measurement
it shrinks by ``exp(-interval * frequency)`` and takes up
``interval * N(0, sqrt(2 * frequency) * drift)``.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gazelle.array_types import Floats, Worlds
from gazelle.description import Parameters
from gazelle.engines.limits import NANOSECONDS
from gazelle.errors import FormatError
from gazelle.simulation import Tunable, Tuning
from gazelle.streams import Stream

_TAGS = {
    "offset": 0.0,
    "drift": 0.0,
    "driftFrequency": 1.0 / 3600.0,
    "gaussianNoise": 0.0,
    "scaleError": 1.0,
}
# Those of hector_gazebo_plugins' SensorModel.cfg.
_TUNABLES = (
    Tunable("gaussian_noise", 0.0, 0.0, 10.0, "Standard deviation of the noise"),
    Tunable("offset", 0.0, -10.0, 10.0, "What is always added"),
    Tunable("drift", 0.0, 0.0, 10.0, "Standard deviation of the drift"),
    Tunable("drift_frequency", 0.0, 0.0, 1.0, "Reciprocal of the drift's time constant [Hz]"),
    Tunable("scale_error", 1.0, 0.0, 2.0, "What true values are multiplied by"),
)


class SensorErrors:
    """Errors of one quantity, in every world.

    Args:
        parameters: Holds tags such as ``accelDrift``: one number for all axes, or one each.
        prefix: Such as ``accel``; empty for ``drift`` and the like.
        axes: Numbers a measurement has.
        seed: The run's seed.
        name: Names the random stream.
        nworld: Number of worlds.
    """

    def __init__(
        self, parameters: Parameters, prefix: str, axes: int, seed: int, name: str, nworld: int
    ) -> None:
        self._axes = axes
        # Noise, offset, drift, its frequency and scale, in the order of the tunables.
        tags = ("gaussianNoise", "offset", "drift", "driftFrequency", "scaleError")
        self._numbers: Floats = np.array(
            [_numbers(parameters, prefix, tag, axes, _TAGS[tag]) for tag in tags]
        )
        rows: list[Floats] = list(self._numbers)
        self.spread, self.offset, self._drift, self._frequency, self._scale = rows
        self._stream = Stream(seed, name, nworld)
        self._drifted: Floats = np.zeros((nworld, axes))
        self._noise: Floats = np.zeros((nworld, axes))
        self._begin(None)

    @property
    def bias(self) -> Floats:
        """The error without noise, shape (nworld, axes)."""
        return self.offset + self._drifted

    @property
    def variance(self) -> Floats:
        """Variance of drift and noise together, shape (axes,)."""
        return self._drift**2 + self.spread**2

    @property
    def error(self) -> Floats:
        """Error of the last measurement, shape (nworld, axes)."""
        return self.offset + self._drifted + self._noise

    def apply(self, values: Floats, interval: float) -> Floats:
        """Return measured values, from true ones of shape (nworld, axes).

        Args:
            values: True.
            interval: Since the last measurement [s].
        """
        keep = np.exp(-interval * self._frequency)
        taken = np.sqrt(2.0 * self._frequency) * self._drift * interval
        if taken.any():
            self._drifted = keep * self._drifted + taken * self._stream.normal(self._axes)
        else:
            self._drifted = keep * self._drifted
        if self.spread.any():
            self._noise = self.spread * self._stream.normal(self._axes)
        return values * self._scale + self.error

    def set_drift(self, values: ArrayLike, worlds: Worlds | None) -> None:
        """Set the present error, from which it drifts on."""
        self._drifted[slice(None) if worlds is None else worlds] = values

    @property
    def drifted(self) -> Floats:
        """The share of drift in the error, shape (nworld, axes)."""
        return self._drifted

    def tuning(self, topic: str) -> Tuning:
        """Return the dynamic_reconfigure parameters; a set value applies to all axes, their mean is reported."""
        return Tuning(topic, _TUNABLES, self._tune, self._tuned)

    def _tune(self, values: Mapping[str, float]) -> None:
        known = self._tuned()
        for row, (name, value) in zip(self._numbers, values.items(), strict=True):
            # What was not changed stays as it is on each axis.
            if value != known[name]:
                row[:] = value

    def _tuned(self) -> dict[str, float]:
        means = self._numbers.mean(axis=1).tolist()
        return {each.name: mean for each, mean in zip(_TUNABLES, means, strict=True)}

    def _begin(self, worlds: Worlds | None) -> None:
        if self._drift.any():
            self.set_drift(self._drift * self._stream.normal(self._axes, worlds), worlds)
        else:
            self.set_drift(0.0, worlds)
        self._noise[slice(None) if worlds is None else worlds] = 0.0

    def reseed(self, seed: int, worlds: Worlds | None = None) -> None:
        """Set the seed of the random numbers."""
        self._stream.reseed(seed, worlds)

    def reset(self, worlds: Worlds | None = None) -> None:
        """Restart the drift; for all worlds, also the random numbers."""
        if worlds is None:
            self._stream.rewind()
        self._begin(worlds)

    def state(self) -> dict[str, NDArray[np.generic]]:
        """Return all mutable state."""
        return {
            "keys": self._stream.keys.copy(),
            "counters": self._stream.counters.copy(),
            "drifted": self._drifted.copy(),
            "noise": self._noise.copy(),
            "numbers": self._numbers.copy(),
        }

    def restore(self, state: dict[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        self._stream.keys[:], self._stream.counters[:] = state["keys"], state["counters"]
        self._drifted[:], self._noise[:] = state["drifted"], state["noise"]
        self._numbers[:] = state["numbers"]


class Interval:
    """Time since the last measurement."""

    def __init__(self) -> None:
        self._last_ns: int | None = None

    def since(self, now_ns: int) -> float:
        """Return the time since the last call [s]; 0 at the first and when time went back."""
        last, self._last_ns = self._last_ns, now_ns
        return max(0, now_ns - last) / NANOSECONDS if last is not None else 0.0

    def reseed(self, seed: int, worlds: Worlds | None = None) -> None:
        """Do nothing: there are no random numbers."""

    def reset(self, worlds: Worlds | None = None) -> None:
        """Start over when all worlds do."""
        if worlds is None:
            self._last_ns = None

    def state(self) -> dict[str, NDArray[np.generic]]:
        """Return the last time [ns]; -1 for none."""
        return {"last": np.array(-1 if self._last_ns is None else self._last_ns)}

    def restore(self, state: dict[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        last = int(np.asarray(state["last"]))
        self._last_ns = None if last < 0 else last


def _numbers(parameters: Parameters, prefix: str, tag: str, axes: int, default: float) -> Floats:
    name = f"{prefix}{tag[0].upper()}{tag[1:]}" if prefix else tag
    child = parameters.find(name)
    if child is None or not child.text:
        return np.full(axes, default)
    try:
        values = np.array([float(word) for word in child.text.split()])
    except ValueError:
        values = np.empty(0)
    if len(values) not in (1, axes):
        raise FormatError(
            f"expected 1 or {axes} numbers in <{name}>, found '{child.text}'", source=child.source
        )
    return np.broadcast_to(values, axes).copy()
