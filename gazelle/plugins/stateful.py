"""Common base of plugins with noise or sensors of their own: reset, seed, snapshot."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Worlds
from gazelle.simulation import BasePlugin
from gazelle.states import Restorable, restore_all, states_of


class Stateful(Restorable, Protocol):
    """Noise or a sensor: something with random numbers and drifts."""

    def reseed(self, seed: int, worlds: Worlds | None = None) -> None:
        """Set the seed of the random numbers."""

    def reset(self, worlds: Worlds | None = None) -> None:
        """Discard drifts."""


class Noisy(BasePlugin):
    """Keeps all in ``_noises``, which ``load`` fills, with the simulation's resets and seeds."""

    _noises: dict[str, Stateful]

    def reseed(self, seed: int, worlds: Worlds | None) -> None:
        """Set the seed of the random numbers."""
        for each in self._noises.values():
            each.reseed(seed, worlds)

    def reset(self, worlds: Worlds | None) -> None:
        """Discard drifts of noise."""
        for each in self._noises.values():
            each.reset(worlds)

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Return the noise."""
        return states_of(self._noises)

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        restore_all(self._noises, state)
