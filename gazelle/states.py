"""State of several parts, as one mapping for a snapshot."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol

import numpy as np
from numpy.typing import NDArray


class Restorable(Protocol):
    """Object with a state that can be saved and restored."""

    def state(self) -> dict[str, NDArray[np.generic]]:
        """Return all mutable state."""

    def restore(self, state: dict[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""


def states_of(parts: Mapping[str, Restorable]) -> dict[str, NDArray[np.generic]]:
    """Return the states of parts, each key as ``name/key``; no name may be the head of another."""
    return {
        f"{name}/{key}": value
        for name, part in parts.items()
        for key, value in part.state().items()
    }


def restore_all(parts: Mapping[str, Restorable], state: Mapping[str, NDArray[np.generic]]) -> None:
    """Restore what ``states_of`` returned; ``state`` may hold more."""
    for name, part in parts.items():
        start = f"{name}/"
        part.restore({k.removeprefix(start): v for k, v in state.items() if k.startswith(start)})
