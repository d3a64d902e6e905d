"""What plugins with noise or sensors of their own have in common: reset, seed, snapshot."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from gazelle.simulation import Plugin

Worlds = NDArray[np.intp]


class Stateful(Protocol):
    """Noise or a sensor: something with random numbers and drifts."""

    def reseed(self, seed: int, worlds: Worlds | None = None) -> None:
        """Use the random numbers of another seed."""

    def reset(self, worlds: Worlds | None = None) -> None:
        """Forget drifts."""

    def state(self) -> dict[str, NDArray[np.generic]]:
        """Everything that changes."""

    def restore(self, state: dict[str, NDArray[np.generic]]) -> None:
        """Put back what ``state`` gave."""


class Noisy(Plugin):
    """Keeps all in ``_noises``, which ``load`` fills, with the simulation's resets and seeds."""

    _noises: dict[str, Stateful]

    def reseed(self, seed: int, worlds: Worlds | None) -> None:
        """Use the random numbers of another seed."""
        for each in self._noises.values():
            each.reseed(seed, worlds)

    def reset(self, worlds: Worlds | None) -> None:
        """Forget drifts of noise."""
        for each in self._noises.values():
            each.reset(worlds)

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """The noise."""
        return {
            f"{name}/{key}": value
            for name, each in self._noises.items()
            for key, value in each.state().items()
        }

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Put back what ``state`` gave."""
        for name, each in self._noises.items():
            own = {
                k.removeprefix(f"{name}/"): v for k, v in state.items() if k.startswith(f"{name}/")
            }
            each.restore(own)
