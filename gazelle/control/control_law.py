# cython: annotation_typing=False, infer_types=True
# mypy: disable-error-code="attr-defined, misc, no-any-return"
"""Base of controllers' updates in native code."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import cython


@cython.cclass
class ControlLaw:
    """Reads joints and commands them, in the arrays of the robot's hardware; this one does nothing.

    Kernel modules subclass it and override ``control``. Arrays have the worlds first, and worlds
    know nothing of each other.

    Args:
        nworld: Number of worlds.
    """

    def __init__(self, nworld: int) -> None:
        self.nworld = nworld

    def control(self, world: int, now: int, period: float) -> None:
        """Update in a world, without the interpreter's lock.

        Args:
            world: Index of the world.
            now: Simulated time [ns].
            period: Since the last update [s].
        """

    def take_over(self, hardware: Any) -> Sequence[int]:  # noqa: ARG002  this one never does
        """Return the joints that ``exchange`` reads and writes, in place of a ``JointLaw``; none by default."""
        return ()

    def exchange(self, world: int, measured: Any, rates: Any, period: float) -> None:
        """Read, update and write the joints that were taken over, each at once.

        Args:
            world: Index of the world.
            measured: Positions of all joints of the hardware.
            rates: Their velocities.
            period: Since the last update [s].
        """

    def act(self, now: int, period: float) -> None:
        """Call ``control`` in all worlds, for callers in Python."""
        when, passed = now, period
        with cython.nogil:
            for w in range(self.nworld):
                self.control(w, when, passed)
