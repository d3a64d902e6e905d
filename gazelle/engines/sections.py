"""Level sections of collision shapes, at the heights of lidars and of robots' bases.

Upright shapes - boxes, cylinders, extruded outlines - keep their outline at all of their
heights. All others are cut level: once at the height of each lidar, for its rays, and once, or
as a whole if they move, where robots collide with them.
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from gazelle.array_types import Floats
from gazelle.description import (
    Box,
    Collision,
    Cylinder,
    Empty,
    Heightmap,
    Image,
    Plane,
    Polyline,
    Pose,
    Sphere,
)
from gazelle.engines.triangle_solids import Solid, cut, solid_of
from gazelle.errors import EngineWarning
from gazelle.geometry.planar_part import PlanarPart
from gazelle.geometry.polygons import Point, convex_polygons, planar_hull

LEVEL = 1e-3  # how far a ray may be off the height of a cut [m]
_UPRIGHT = 1e-9


@dataclass(frozen=True, slots=True)
class Levels:
    """Heights at which a world is cut.

    Attributes:
        rays: Of lidars [m].
        low: Lowest height at which robots bump into something [m].
        high: Highest.
    """

    rays: tuple[float, ...]
    low: float
    high: float

    def lowered(self, z: float) -> Levels:
        """The same seen from a frame at height z."""
        return Levels(tuple(level - z for level in self.rays), self.low - z, self.high - z)


def parts_of(collision: Collision, pose: Pose, levels: Levels, *, moving: bool) -> list[PlanarPart]:
    """Parts of a collision whose shape is at a pose; the levels are in the same frame.

    Raises:
        FormatError: A mesh cannot be read.
    """
    shape, glow = collision.geometry, max(collision.laser_retro, 0.0)
    if isinstance(shape, Empty | Plane):
        return []
    if isinstance(shape, Heightmap):
        warnings.warn(
            EngineWarning(f"collision '{collision.name}': a plane has no terrain; it is left out"),
            stacklevel=2,
        )
        return []
    upright = list(_upright(collision, pose, glow))
    if upright:
        return upright
    if isinstance(shape, Sphere):
        return _sphere(shape, pose, levels, glow)
    solid = solid_of(shape, pose)
    return [] if solid is None else _cut(solid, levels, glow, moving=moving)


def _upright(collision: Collision, pose: Pose, glow: float) -> Iterator[PlanarPart]:
    """Parts of a shape that stands upright; none if it does not."""
    shape = collision.geometry
    _, _, up = pose.rotate((0.0, 0.0, 1.0))
    if abs(up) < 1.0 - _UPRIGHT:
        return
    if isinstance(shape, Cylinder):
        half = shape.length / 2.0
        yield _circle(pose, shape.radius, pose.z - half, pose.z + half, glow)
    elif isinstance(shape, Box):
        w, d, h = (side / 2.0 for side in shape.size)
        ring = ((-w, -d), (w, -d), (w, d), (-w, d))
        yield _prism(ring, pose, -h, h, glow)
    elif isinstance(shape, Polyline):
        for polygon in convex_polygons(shape.outlines):
            corners = [(float(x), float(y)) for x, y in polygon]
            yield _prism(corners, pose, 0.0, shape.height, glow)
    elif isinstance(shape, Image) and shape.path is not None:
        from gazelle.formats.terrain import load_boxes

        for x, y, width, depth in load_boxes(shape).tolist():
            w, d = width / 2.0, depth / 2.0
            corners = [(x - w, y - d), (x + w, y - d), (x + w, y + d), (x - w, y + d)]
            yield _prism(corners, pose, 0.0, shape.height, glow)


def _prism(ring: Sequence[Point], pose: Pose, low: float, high: float, glow: float) -> PlanarPart:
    corners = [pose.apply((x, y, low)) for x, y in ring]
    top = pose.apply((0.0, 0.0, high))[2]
    bottom = corners[0][2]
    return PlanarPart(
        tuple((x, y) for x, y, _ in corners),
        low=min(bottom, top),
        high=max(bottom, top),
        glow=glow,
    )


def _circle(pose: Pose, radius: float, low: float, high: float, glow: float) -> PlanarPart:
    return PlanarPart(((pose.x, pose.y),), radius, low=low, high=high, glow=glow)


def _sphere(shape: Sphere, pose: Pose, levels: Levels, glow: float) -> list[PlanarPart]:
    parts = []
    for level in levels.rays:
        square = shape.radius**2 - (level - pose.z) ** 2
        if square > 0.0:
            ring = _circle(pose, math.sqrt(square), level - LEVEL, level + LEVEL, glow)
            parts.append(_ghost(ring))
    nearest = min(max(pose.z, levels.low), levels.high)
    square = shape.radius**2 - (nearest - pose.z) ** 2
    if square > 0.0:
        bottom, top = pose.z - shape.radius, pose.z + shape.radius
        parts.append(_circle(pose, math.sqrt(square), bottom, top, -1.0))
    return parts


def _ghost(part: PlanarPart) -> PlanarPart:
    return PlanarPart(
        part.points, part.radius, part.closed, part.low, part.high, part.glow, solid=False
    )


def _cut(solid: Solid, levels: Levels, glow: float, *, moving: bool) -> list[PlanarPart]:
    """Parts of a shape that leans, or of a mesh."""
    heights = solid[0][:, 2]
    bottom, top = float(heights.min()), float(heights.max())
    parts = []
    for level in levels.rays:
        if bottom < level < top:
            lines = cut(solid, level)
            parts += _lines(lines, level - LEVEL, level + LEVEL, glow, solid=False)
    low, high = max(bottom, levels.low), min(top, levels.high)
    if low >= high:
        return parts
    if not moving:
        return parts + _lines(cut(solid, (low + high) / 2.0), bottom, top, -1.0, solid=True)
    rims = [cut(solid, height).reshape(-1, 2) for height in np.linspace(low, high, 7)[1:-1]]
    between = solid[0][(heights >= low) & (heights <= high), :2]
    points = np.vstack((*rims, between))
    hull = points[planar_hull(points)] if len(points) >= 3 else points
    if len(hull) >= 3:
        ring = tuple((float(x), float(y)) for x, y in hull)
        parts.append(PlanarPart(ring, low=bottom, high=top, glow=-1.0))
    return parts


def _lines(lines: Floats, low: float, high: float, glow: float, *, solid: bool) -> list[PlanarPart]:
    return [
        PlanarPart(((a, b), (c, d)), 0.0, closed=False, low=low, high=high, glow=glow, solid=solid)
        for a, b, c, d in lines.tolist()
    ]
