# cython: annotation_typing=False, infer_types=True
# mypy: disable-error-code="attr-defined, misc, no-any-return"
"""Base of controllers' updates in native code."""

from __future__ import annotations

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

    def act(self, now: int, period: float) -> None:
        """Call ``control`` in all worlds, for callers in Python."""
        when, passed = now, period
        with cython.nogil:
            for w in range(self.nworld):
                self.control(w, when, passed)
