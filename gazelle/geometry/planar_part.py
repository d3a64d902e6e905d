"""A part of a scene seen from above: an outline between two heights."""

from __future__ import annotations

import math
from dataclasses import dataclass

from gazelle.argument_checks import checked
from gazelle.errors import EngineError
from gazelle.geometry.polygons import Point


@checked(EngineError)
@dataclass(frozen=True, slots=True)
class PlanarPart:
    """Outline between two heights, in the frame of its body or of the world.

    Attributes:
        points: Corners [m]; of a circle its centre alone.
        radius: Of a circle [m]; 0 for a polygon or lines.
        closed: The last corner is joined to the first, and the inside is solid.
        low: Lowest height [m].
        high: Highest height [m].
        glow: Laser return; negative: no ray meets it.
        solid: Bodies collide with it.
        tag: A number that scanners report for what rays met.

    Raises:
        EngineError: A number is invalid.
    """

    points: tuple[Point, ...]
    radius: float = 0.0
    closed: bool = True
    low: float = -math.inf
    high: float = math.inf
    glow: float = 1.0
    solid: bool = True
    tag: int = 0

    @classmethod
    def circle(cls, x: float, y: float, radius: float) -> PlanarPart:
        """Return a disc about (x, y)."""
        return cls(((x, y),), radius)

    @classmethod
    def box(cls, width: float, depth: float, x: float = 0.0, y: float = 0.0) -> PlanarPart:
        """Return a rectangle about (x, y), ``width`` along x [m]."""
        w, d = width / 2.0, depth / 2.0
        return cls(((x - w, y - d), (x + w, y - d), (x + w, y + d), (x - w, y + d)))
