"""Occupancy grids, as in ROS's ``nav_msgs/OccupancyGrid``."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from gazelle.argument_checks import checked
from gazelle.description.pose import Pose
from gazelle.description.source import Source
from gazelle.errors import FormatError

FREE = 0
OCCUPIED = 100
UNKNOWN = -1


@checked(FormatError)
@dataclass(frozen=True, slots=True, eq=False)
class OccupancyMap:
    """A grid of square cells.

    Attributes:
        data: 0 free to 100 occupied, -1 unknown, shape (height, width), int8; row 0 is the
            lowest, y grows with the row, x with the column. A map of mode ``raw`` may hold
            any value.
        resolution: Side of a cell [m].
        origin: Of the lower left corner of cell (0, 0) in the map frame; z, roll, pitch are 0.
        name: Of the map; its file's, without suffix.
    """

    data: NDArray[np.int8]
    resolution: float
    origin: Pose = field(default_factory=Pose)
    name: str = "map"
    source: Source | None = field(default=None, repr=False)

    @property
    def height(self) -> int:
        """Number of rows, along y."""
        return int(self.data.shape[0])

    @property
    def width(self) -> int:
        """Number of columns, along x."""
        return int(self.data.shape[1])

    @property
    def size(self) -> tuple[float, float]:
        """Length along x and along y [m]."""
        return (self.width * self.resolution, self.height * self.resolution)

    def __eq__(self, other: object) -> bool:
        return (
            isinstance(other, OccupancyMap)
            and self.resolution == other.resolution
            and self.origin == other.origin
            and np.array_equal(self.data, other.data)
        )

    def __hash__(self) -> int:
        return hash((self.data.shape, self.data.tobytes(), self.resolution, self.origin))
