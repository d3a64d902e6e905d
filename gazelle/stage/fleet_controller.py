"""Controllers that drive robots of Stage files from one step to the next."""

from __future__ import annotations

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Worlds
from gazelle.native.system import System


class FleetController(Protocol):
    """Controller of all robots of a fleet: drives them, or modifies their readings."""

    def update(self) -> None:
        """Update the robots between two steps: read scans, write commands."""

    def systems(self) -> list[System] | None:
        """Return the native systems of ``update``, step by step; None if it does more."""
        return None

    def reset(self, worlds: Worlds | None = None) -> None:
        """Start over in some worlds, all if None."""

    def rebind(self) -> None:
        """Look up the engine's data again after other models changed; the robots are the same."""

    def state(self) -> dict[str, NDArray[np.generic]]:
        """Return all mutable state, for a snapshot."""
        return {}

    def restore(self, state: dict[str, NDArray[np.generic]]) -> None:  # noqa: ARG002  of others
        """Restore what ``state`` returned."""
        return
