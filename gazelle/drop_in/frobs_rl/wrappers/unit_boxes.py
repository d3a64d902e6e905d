"""Boxes rescaled to bounds of -1 and 1."""

from __future__ import annotations

from typing import Any

import numpy as np
from gymnasium.spaces import Box
from numpy.typing import NDArray

from gazelle.errors import TaskError


class UnitBox:
    """A box that another one from -1 to 1 stands for, entry by entry.

    Args:
        space: The box.
        what: Content, for the error.

    Attributes:
        low: Lower bounds of the box.
        high: Upper bounds of the box.
        space: The box from -1 to 1.

    Raises:
        TaskError: It is no box.
    """

    def __init__(self, space: Any, what: str) -> None:
        if not isinstance(space, Box):
            raise TaskError(f"this wants a box of {what}, not {space}")
        self.low, self.high = space.low, space.high
        self.space = Box(-1.0, 1.0, space.shape, np.float32)

    def shrunk(self, values: NDArray[Any]) -> NDArray[Any]:
        """Return values of the box, scaled so that its bounds become -1 and 1."""
        scaled: NDArray[Any] = 2.0 * (values - self.low) / (self.high - self.low) - 1.0
        return scaled

    def stretched(self, values: Any) -> NDArray[Any]:
        """Return the values of scaled ones, the inverse of `shrunk`."""
        grown: NDArray[Any] = self.low + 0.5 * (values + 1.0) * (self.high - self.low)
        return grown
