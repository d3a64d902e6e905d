"""What stands in a world, seen from above."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class FloorPlan:
    """What stands in the way of a robot, seen from above.

    Attributes:
        segments: Both ends [m], shape (n, 4).
        discs: Middles and radii [m], shape (m, 3).
    """

    segments: Floats
    discs: Floats
