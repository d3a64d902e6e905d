"""Obstacles of a world, seen from above."""

from __future__ import annotations

from dataclasses import dataclass

from gazelle.array_types import Floats


@dataclass(frozen=True, slots=True)
class FloorPlan:
    """Obstacles of a robot, seen from above.

    Attributes:
        segments: Both ends [m], shape (n, 4).
        discs: Middles and radii [m], shape (m, 3).
    """

    segments: Floats
    discs: Floats
