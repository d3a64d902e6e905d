"""Frames that plugins hear of on ``/tf``: how one is turned against another."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from gazelle.rotations import conjugate, multiply
from gazelle.simulation import Transforms

Floats = NDArray[np.float64]
Worlds = NDArray[np.intp]

_UPRIGHT = np.array([0.0, 0.0, 0.0, 1.0])


class HeardFrames:
    """The latest orientation of every frame in its parent, in every world.

    Args:
        nworld: Number of worlds.
    """

    def __init__(self, nworld: int) -> None:
        self._nworld = nworld
        self._parents: dict[str, str] = {}
        self._turns: dict[str, Floats] = {}

    def hear(self, transforms: Transforms, worlds: Worlds | None) -> None:
        """Take what is told; for worlds that nobody told of, frames are as in their parents."""
        for each in transforms.transforms:
            child, parent = each.child_frame.lstrip("/"), each.frame.lstrip("/")
            turns = self._turns.setdefault(child, np.tile(_UPRIGHT, (self._nworld, 1)))
            turns[slice(None) if worlds is None else worlds] = each.quaternion
            self._parents[child] = parent

    def turn(self, target: str, source: str) -> Floats | None:
        """The orientation of a frame seen from another, shape (nworld, 4); None if not known."""
        above_target, above_source = self._above(target), self._above(source)
        for frame, turn in above_source.items():
            if frame in above_target:
                return multiply(conjugate(above_target[frame]), turn)
        return None

    def _above(self, frame: str) -> dict[str, Floats]:
        """A frame and all above it, with its orientation in each."""
        turn = np.tile(_UPRIGHT, (self._nworld, 1))
        found = {frame: turn}
        while frame in self._parents and self._parents[frame] not in found:
            turn = multiply(self._turns[frame], turn)
            frame = self._parents[frame]
            found[frame] = turn
        return found

    def clear(self) -> None:
        """Forget everything."""
        self._parents.clear()
        self._turns.clear()

    def state(self) -> dict[str, NDArray[np.generic]]:
        """All that was heard."""
        names = list(self._parents)
        return {
            "frames": np.array(names, np.str_),
            "parents": np.array([self._parents[name] for name in names], np.str_),
            "turns": np.array([self._turns[name] for name in names], np.float64),
        }

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Put back what ``state`` gave."""
        self.clear()
        for name, parent, turn in zip(
            state["frames"], state["parents"], state["turns"], strict=True
        ):
            self._parents[str(name)] = str(parent)
            self._turns[str(name)] = np.array(turn, np.float64)
