"""Sensor noise for all worlds at once, each world with its own random numbers."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gazelle.argument_checks import checked
from gazelle.array_types import Floats, Indices, UInts64, Worlds
from gazelle.description import Noise
from gazelle.engines.limits import MAX_VALUES
from gazelle.errors import SimulationError
from gazelle.sensors.limits import check_interval
from gazelle.streams import Stream

NO_NOISE = Noise()


@checked(SimulationError, after=True)
class NoiseModel:
    """White noise, a constant bias and a drifting bias on one group of channels.

    As in Gazebo: the constant bias is drawn once a run with random sign, the drifting bias
    is a first-order Gauss-Markov process, and quantising comes last.

    Args:
        noise: Settings of the file.
        seed: The run's seed.
        name: Names the random stream; unique for each channel group.
        nworld: Number of worlds.
        channels: Number of values a measurement has.

    Raises:
        SimulationError: They are too many, or a number below 0.
    """

    def __init__(self, noise: Noise, seed: int, name: str, nworld: int, channels: int) -> None:
        if min(nworld, channels) < 0 or nworld * channels > MAX_VALUES:
            raise SimulationError(
                f"there is no noise on {channels} values in each of {nworld} worlds, but on "
                f"{MAX_VALUES:,} at most"
            )
        self._noise = noise
        self._channels = channels
        self._stream = Stream(seed, name, nworld)
        self._bias_stream = Stream(seed, f"{name}/bias", nworld)
        self._bias = np.zeros((nworld, channels))
        self._drift = np.zeros((nworld, channels))
        self._active = noise.type != "none"
        self._changes = (
            noise.dynamic_bias_stddev > 0.0 and noise.dynamic_bias_correlation_time > 0.0
        )
        self._stddev = np.full((nworld, 1), noise.stddev if self._active else 0.0)
        self._spread = bool(self._stddev.any())
        self._biased = self._active and (noise.bias_mean != 0.0 or noise.bias_stddev != 0.0)
        self._draw_bias(None)

    @property
    def active(self) -> bool:
        """True if it changes values."""
        return self._active

    @property
    def stddev(self) -> Floats:
        """Standard deviation of the white noise in each world, shape (nworld,); settable."""
        return self._stddev[:, 0].copy()

    @stddev.setter
    def stddev(self, values: Floats) -> None:
        self._stddev[:, 0] = values
        self._spread = bool(self._stddev.any())
        self._active = self._noise.type != "none" or self._spread

    def tables(
        self, worlds: Worlds | None = None
    ) -> tuple[Floats, NDArray[np.uint64], NDArray[np.uint64], Floats]:
        """Return the noise tables for native code, without drifts: in place, or copies for some worlds.

        Returns:
            Standard deviations, shape (n,), keys and counters of the stream, and the constant bias
            of each channel, shape (n, channels), or no rows if there is none.
        """
        stream, rows = self._stream, slice(None) if worlds is None else worlds
        bias = self._bias[rows] if self._biased else self._bias[:0]
        return self._stddev[rows, 0], stream.keys[rows], stream.counters[rows], bias

    def follow(self, worlds: Worlds, counters: UInts64) -> None:
        """Continue the streams of some worlds after this number of draws, shape (n,)."""
        self._stream.counters[worlds] = counters

    def move(self, stddev: Floats, keys: UInts64, counters: UInts64, bias: Floats) -> None:
        """Store its state in other arrays from now on, as one row of many models' tables.

        Args:
            stddev: Shape (nworld, 1).
            keys: Shape (nworld,).
            counters: Shape (nworld,).
            bias: Shape (nworld, channels); not looked at if it has no constant bias.
        """
        stddev[:] = self._stddev
        self._stddev = stddev
        self._stream.move(keys, counters)
        if self._biased:
            bias[:] = self._bias
            self._bias = bias

    def move_drift(self, drift: Floats) -> None:
        """Store the drift in another array from now on, shape (nworld, channels)."""
        drift[:] = self._drift
        self._drift = drift

    @property
    def description(self) -> Noise:
        """Noise as described in the file."""
        return self._noise

    @property
    def channels(self) -> int:
        """Number of values a measurement has."""
        return self._channels

    @property
    def nworld(self) -> int:
        """Number of worlds."""
        return len(self._stddev)

    @property
    def drifts(self) -> bool:
        """True if it has a bias that changes with time."""
        return self._active and self._changes

    @property
    def biased(self) -> bool:
        """True if it has a constant bias."""
        return self._biased

    @property
    def rounding(self) -> tuple[float, float]:
        """Mean of the noise, and what noisy values are rounded to; 0 for not."""
        if not self._active:
            return 0.0, 0.0
        noise = self._noise
        rounded = noise.type == "gaussian_quantized" and noise.precision > 0.0
        return noise.mean, noise.precision if rounded else 0.0

    def reseed(self, seed: int, worlds: Worlds | None = None) -> None:
        """Set the seed of the random numbers and start them again; a reset draws new biases."""
        self._stream.reseed(seed, worlds)
        self._bias_stream.reseed(seed, worlds)

    def reset(self, worlds: Worlds | None = None) -> None:
        """Draw new biases; with all worlds, the random numbers start over too."""
        if worlds is None:
            self._stream.rewind()
            self._bias_stream.rewind()
        if self.drifts:
            self._drift[slice(None) if worlds is None else worlds] = 0.0
        if self._biased:
            self._draw_bias(worlds)

    def apply(self, values: Floats, interval: float, worlds: Worlds | None = None) -> Floats:
        """Return values with noise.

        Args:
            values: True values, shape (n, channels).
            interval: Time since the last measurement [s], for the drift.
            worlds: Worlds of the rows.

        Returns:
            Measured values, shape (n, channels).
        """
        check_interval(interval)
        if not self._active:
            return values
        rows = NoiseRows(self._noise, self._stream, self._stddev, self._bias, self._drift)
        return rows.apply(values, interval, worlds, spread=self._spread)

    def state(self) -> dict[str, NDArray[np.generic]]:
        """Return all mutable state, for a snapshot."""
        return {
            "counters": self._stream.counters.copy(),
            "bias_counters": self._bias_stream.counters.copy(),
            "bias": self._bias.copy(),
            "drift": self._drift.copy(),
            "keys": self._stream.keys.copy(),
            "bias_keys": self._bias_stream.keys.copy(),
            "stddev": self.stddev,
        }

    def restore(self, state: dict[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        self._stream.counters[:] = state["counters"]
        self._bias_stream.counters[:] = state["bias_counters"]
        self._bias[:] = state["bias"]
        self._drift[:] = state["drift"]
        self._stream.keys[:] = state["keys"]
        self._bias_stream.keys[:] = state["bias_keys"]
        self.stddev = np.asarray(state["stddev"], np.float64)

    def _draw_bias(self, worlds: Worlds | None) -> None:
        noise = self._noise
        if not self._active or (noise.bias_mean == 0.0 and noise.bias_stddev == 0.0):
            return
        rows = slice(None) if worlds is None else worlds
        size = noise.bias_mean + noise.bias_stddev * self._bias_stream.normal(
            self._channels, worlds
        )
        sign = np.where(self._bias_stream.uniform(self._channels, worlds) < 0.5, -1.0, 1.0)
        self._bias[rows] = sign * size


@dataclass(frozen=True, slots=True)
class NoiseRows:
    """State of noise of each world, or of each world and sensor of a kind.

    Attributes:
        noise: Settings of the file.
        stream: Of the rows.
        stddev: Shape (rows, 1).
        bias: Shape (rows, channels).
        drift: Likewise.
    """

    noise: Noise
    stream: Stream
    stddev: Floats
    bias: Floats
    drift: Floats

    def apply(
        self, values: Floats, interval: float, chosen: Indices | None, *, spread: bool
    ) -> Floats:
        """Return values with noise; see ``NoiseModel.apply``.

        Args:
            values: True values, shape (n, channels).
            interval: Time since the last measurement [s].
            chosen: Rows; all if None.
            spread: Whether there is white noise.
        """
        noise, channels = self.noise, values.shape[1]
        rows = slice(None) if chosen is None else chosen
        measured = values + noise.mean + self.bias[rows]
        if spread:
            measured = measured + self.stddev[rows] * self.stream.normal(channels, chosen)
        if noise.dynamic_bias_stddev > 0.0 and noise.dynamic_bias_correlation_time > 0.0:
            self._advance_drift(channels, interval, chosen)
            measured = measured + self.drift[rows]
        if noise.type == "gaussian_quantized" and noise.precision > 0.0:
            measured = np.round(measured / noise.precision) * noise.precision
        return measured

    def _advance_drift(self, channels: int, interval: float, chosen: Indices | None) -> None:
        """Advance the process b' = -b / T + white noise by one step, exactly discretised."""
        noise = self.noise
        rows = slice(None) if chosen is None else chosen
        keep = math.exp(-interval / noise.dynamic_bias_correlation_time)
        spread = noise.dynamic_bias_stddev * math.sqrt(1.0 - keep * keep)
        draw = self.stream.normal(channels, chosen)
        self.drift[rows] = keep * self.drift[rows] + spread * draw


class JoinedNoise:
    """The noise of sensors with equal parameters, applied at once.

    Args:
        models: Models that keep their state in its tables from now on.
    """

    def __init__(self, models: Sequence[NoiseModel]) -> None:
        noise, channels = models[0].description, models[0].channels
        shape = models[0].nworld, len(models)
        self._stddev = np.zeros(shape)
        stream = Stream(0, "", self._stddev.size)  # with the numbers of the models' streams
        keys, counters = stream.keys.reshape(shape), stream.counters.reshape(shape)
        bias, drift = np.zeros((2, *shape, channels))
        for i, each in enumerate(models):
            each.move(self._stddev[:, i : i + 1], keys[:, i], counters[:, i], bias[:, i])
            each.move_drift(drift[:, i])
        self._rows = NoiseRows(
            noise,
            stream,
            self._stddev.reshape(-1, 1),
            bias.reshape(-1, channels),
            drift.reshape(-1, channels),
        )

    def apply(self, values: Floats, interval: float) -> Floats:
        """Return values with noise, shape (nworld, n, channels); see ``NoiseModel.apply``."""
        nworld = len(values)
        rows = values.reshape(-1, values.shape[2])
        spread = self._stddev.any(axis=0)  # a model draws for all of its worlds or for none
        if spread.all() or not spread.any():
            return self._apply(rows, interval, None, spread=bool(spread.all())).reshape(
                values.shape
            )
        measured = np.empty_like(rows)
        for some in (True, False):
            chosen = np.flatnonzero(np.tile(spread == some, nworld))
            measured[chosen] = self._apply(rows[chosen], interval, chosen, spread=some)
        return measured.reshape(values.shape)

    def _apply(
        self, values: Floats, interval: float, chosen: Indices | None, *, spread: bool
    ) -> Floats:
        if self._rows.noise.type == "none" and not spread:
            return values
        return self._rows.apply(values, interval, chosen, spread=spread)
