"""The planar engine: fast kinematic simulation of worlds in two dimensions."""

from __future__ import annotations

from pathlib import Path

from gazelle.native import search_path

__path__ = search_path([str(Path(__file__).parent)])

from gazelle.engines.planar.angle_noise import AngleNoiseScanner
from gazelle.engines.planar.drive_velocities import DriveVelocities
from gazelle.engines.planar.engine import PlanarEngine
from gazelle.engines.planar.fans import Fan, Mount, RangeNoise, Scanner
from gazelle.engines.planar.fleet import Fleet
from gazelle.engines.planar.fleet_bodies import Body, Drive
from gazelle.engines.planar.footprints import footprint_of, outline_of
from gazelle.engines.planar.kind_layouts import KindLayout, KindLayoutFactory
from gazelle.engines.planar.shapes import PrimitiveTable, Raster, primitives_of, segments_of
from gazelle.geometry.planar_part import PlanarPart

__all__ = [
    "AngleNoiseScanner",
    "Body",
    "Drive",
    "DriveVelocities",
    "Fan",
    "Fleet",
    "KindLayout",
    "KindLayoutFactory",
    "Mount",
    "PlanarEngine",
    "PlanarPart",
    "PrimitiveTable",
    "RangeNoise",
    "Raster",
    "Scanner",
    "footprint_of",
    "outline_of",
    "primitives_of",
    "segments_of",
]
