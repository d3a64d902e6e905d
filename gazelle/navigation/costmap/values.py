"""Values of a costmap and their form in messages."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Bytes

FREE_SPACE: Final = 0
INSCRIBED: Final = 253
LETHAL: Final = 254
NO_INFORMATION: Final = 255

_SHOWN: Final = np.array(
    [0, *(1 + 97 * (cost - 1) // 251 for cost in range(1, 253)), 99, 100, -1], np.int8
)


def shown(cells: Bytes) -> NDArray[np.int8]:
    """Return costs as in ``nav_msgs/OccupancyGrid``: 254 is 100, 253 is 99, unknown is -1."""
    return _SHOWN[cells]


@dataclass(slots=True)
class CostmapBounds:
    """A rectangle that grows: what of a map is to be updated, in the map's frame [m]."""

    x0: float = np.inf
    y0: float = np.inf
    x1: float = -np.inf
    y1: float = -np.inf

    def touch(self, x: float, y: float) -> None:
        """Include a point."""
        self.x0, self.y0 = min(self.x0, x), min(self.y0, y)
        self.x1, self.y1 = max(self.x1, x), max(self.y1, y)

    def grow(self, reach: float) -> None:
        """Grow to all sides."""
        self.x0, self.y0 = self.x0 - reach, self.y0 - reach
        self.x1, self.y1 = self.x1 + reach, self.y1 + reach


@dataclass(frozen=True, slots=True)
class Window:
    """A rectangle of cells: columns ``x0`` to ``x1`` and rows ``y0`` to ``y1``, the last ones not included."""

    x0: int
    y0: int
    x1: int
    y1: int

    @property
    def slices(self) -> tuple[slice, slice]:
        """Index of an array's window."""
        return slice(self.y0, self.y1), slice(self.x0, self.x1)
