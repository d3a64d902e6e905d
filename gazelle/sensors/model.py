"""Common interface of all sensors."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from gazelle.argument_checks import checked
from gazelle.array_types import Floats, Worlds
from gazelle.description import Noise
from gazelle.errors import SimulationError
from gazelle.native.system import System
from gazelle.sensors.limits import check_interval
from gazelle.sensors.noise import NoiseModel
from gazelle.states import restore_all, states_of


class SensorModel(Protocol):
    """Measures one sensor in every world."""

    def measure(self, worlds: Worlds | None = None, interval: float = 0.0) -> NDArray[Any]:
        """Measure now, shape (n, channels).

        Args:
            worlds: Worlds; all if None.
            interval: Time since the last measurement [s].
        """

    def reading(self, values: NDArray[Any], stamp: int) -> Any:
        """Return a measurement by name.

        ``values`` are of one world, shape (channels,), or of many.
        """

    def reseed(self, seed: int, worlds: Worlds | None = None) -> None:
        """Set the seed of the random numbers and start them again."""

    def reset(self, worlds: Worlds | None = None) -> None:
        """Discard drifts of noise."""

    def state(self) -> dict[str, NDArray[np.generic]]:
        """Return all mutable state, for a snapshot."""

    def restore(self, state: dict[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""


@runtime_checkable
class ScanningModel(SensorModel, Protocol):
    """Measures one fan of rays, or several above each other; its readings are ``LaserScan``."""

    @property
    def rows(self) -> int:
        """Fans above each other."""

    @property
    def samples(self) -> int:
        """Rays a measurement has, all rows together."""


class SensorSystem(Protocol):
    """Sensors that are measured at once, in every world."""

    @property
    def kernel(self) -> System | None:
        """System that measures them within an engine's steps; None where only Python does."""

    @property
    def latest(self) -> tuple[NDArray[Any], NDArray[np.int64]]:
        """Last measurement of the kernel, shape (nworld, n, channels), and its time, (nworld, n) [ns]."""

    def measure_all(self, interval: float) -> NDArray[Any]:
        """Measure now, shape (nworld, n, channels): the bits of each by itself.

        Args:
            interval: Time since the last measurement [s].
        """


@dataclass(frozen=True, slots=True)
class SystemMaker:
    """Maker of a system, equal for the sensors that share one.

    Attributes:
        make: Makes the system of models, which share its tables from then on.
        like: Value that is the same for all of them; it decides the shape of the tables.
    """

    make: Callable[[Sequence[Any]], SensorSystem]
    like: Hashable


@runtime_checkable
class GroupedModel(SensorModel, Protocol):
    """A sensor that can be measured with others in one system."""

    @property
    def by_system(self) -> bool:
        """True where what measures many has a kernel, which the engine updates in its steps."""

    def system(self) -> SystemMaker | None:
        """Return what makes its system now; None for one that is measured alone."""


class PythonSensors:
    """Sensors that are measured by Python only."""

    kernel: System | None = None

    @property
    def latest(self) -> tuple[NDArray[Any], NDArray[np.int64]]:
        """Error: there is no kernel that measures.

        Raises:
            TypeError: Always.
        """
        raise TypeError(f"{type(self).__name__} has no kernel")


@checked(SimulationError, after=True)
class NoisySensor:
    """Holds the noise of a sensor's channels, each with random numbers of its own.

    Args:
        noises: By name of the channel, in the order of the channels.
        seed: The run's seed.
        name: Scoped name of the sensor; names its random streams.
        nworld: Number of worlds.
    """

    def __init__(self, noises: Mapping[str, Noise], seed: int, name: str, nworld: int) -> None:
        self._noises = [
            NoiseModel(noise, seed, f"{name}/{channel}", nworld, 1)
            for channel, noise in noises.items()
        ]

    @property
    def noises(self) -> tuple[NoiseModel, ...]:
        """The noise of every channel that has some model."""
        return tuple(self._noises)

    def noisy(self, values: Floats, interval: float, worlds: Worlds | None) -> Floats:
        """Return True values with noise, shape (n, channels).

        The same array where there is none.
        """
        check_interval(interval)
        if not any(model.active for model in self._noises):
            return values
        columns = [
            model.apply(values[:, i : i + 1], interval, worlds)
            for i, model in enumerate(self._noises)
        ]
        return np.concatenate(columns, axis=1)

    def reseed(self, seed: int, worlds: Worlds | None = None) -> None:
        """Set the seed of the random numbers and start them again."""
        for noise in self._noises:
            noise.reseed(seed, worlds)

    def reset(self, worlds: Worlds | None = None) -> None:
        """Discard drifts of noise."""
        for noise in self._noises:
            noise.reset(worlds)

    def state(self) -> dict[str, NDArray[np.generic]]:
        """Return all mutable state, for a snapshot."""
        return states_of(self._channels())

    def restore(self, state: dict[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        restore_all(self._channels(), state)

    def _channels(self) -> dict[str, NoiseModel]:
        return {str(i): noise for i, noise in enumerate(self._noises)}
