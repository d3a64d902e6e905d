"""The planar engine: worlds seen from above, kinematic, very fast."""

from __future__ import annotations

from gazelle.engines.planar.engine import PlanarEngine
from gazelle.engines.planar.fans import Fan, Mount, RangeNoise, Scanner
from gazelle.engines.planar.fleet import Body, Drive, Fleet
from gazelle.engines.planar.shapes import Part

__all__ = [
    "Body",
    "Drive",
    "Fan",
    "Fleet",
    "Mount",
    "Part",
    "PlanarEngine",
    "RangeNoise",
    "Scanner",
]
