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

from gazelle.array_types import Floats, Ints32
from gazelle.description import (
    Box,
    Capsule,
    Collision,
    Cone,
    Cylinder,
    Ellipsoid,
    Empty,
    Geometry,
    Heightmap,
    Image,
    Mesh,
    Plane,
    Polyline,
    Pose,
    Sphere,
)
from gazelle.errors import EngineWarning
from gazelle.geometry import triangles
from gazelle.geometry.planar_part import PlanarPart
from gazelle.geometry.polygons import Point, convex_polygons, planar_hull

LEVEL = 1e-3  # how far a ray may be off the height of a cut [m]
_UPRIGHT = 1e-9
_SIDES = 64  # of what is round and leans

Solid = tuple[Floats, Ints32]


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
        """Return the same heights in a frame at height z."""
        return Levels(tuple(level - z for level in self.rays), self.low - z, self.high - z)


def parts_of(collision: Collision, pose: Pose, levels: Levels, *, moving: bool) -> list[PlanarPart]:
    """Return parts of a collision with its shape at a pose; the levels are in the same frame.

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
    """Yield parts of an upright shape; none if it is not upright."""
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
    """Return parts of a leaning shape or of a mesh."""
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


def solid_of(shape: Geometry, pose: Pose) -> Solid | None:
    """Return vertices (n, 3) at a pose and faces (m, 3), counter-clockwise from outside; or None.

    Raises:
        FormatError: A mesh cannot be read.
    """
    vertices, faces = _triangles_of(shape)
    if not len(faces):
        return None
    matrix = pose.matrix()
    return vertices @ matrix[:3, :3].T + matrix[:3, 3], faces


def cut(solid: Solid, height: float) -> Floats:
    """Return segments where a solid meets a level plane, solid on their left, shape (n, 4)."""
    vertices, faces = solid
    corners = vertices[faces]
    above = corners[:, :, 2] > height
    # The corner that is alone on its side comes first.
    count = above.sum(axis=1)
    cut_ones = np.flatnonzero((count == 1) | (count == 2))
    alone = np.where(count[cut_ones] == 1, above[cut_ones].argmax(1), above[cut_ones].argmin(1))
    turned = (alone[:, None] + np.arange(3)) % 3
    a, b, c = np.moveaxis(np.take_along_axis(corners[cut_ones], turned[:, :, None], axis=1), 1, 0)
    start, end = _between(a, b, height), _between(a, c, height)
    # Seen from outside, the edge to the next corner is on the left of a corner above the plane.
    flip = count[cut_ones] == 1
    first, last = np.where(flip[:, None], start, end), np.where(flip[:, None], end, start)
    lines = np.hstack((first, last))
    long = np.abs(lines[:, :2] - lines[:, 2:]).max(axis=1) > 0.0
    return np.asarray(lines[long])


def _between(a: Floats, b: Floats, height: float) -> Floats:
    share = (height - a[:, 2]) / (b[:, 2] - a[:, 2])
    return np.asarray(a[:, :2] + share[:, None] * (b[:, :2] - a[:, :2]))


def _triangles_of(shape: Geometry) -> Solid:
    """Return vertices and faces in the shape's frame; none of a shape without a volume."""
    if isinstance(shape, Mesh) and shape.path is not None:
        from gazelle.formats.mesh import load_mesh

        data = load_mesh(shape)
        return data.vertices, data.faces
    if isinstance(shape, Box):
        made = triangles.box(shape.size)
    elif isinstance(shape, Capsule):
        made = triangles.capsule(shape.radius, shape.length, _SIDES)
    elif isinstance(shape, Cone | Cylinder):
        top = shape.radius if isinstance(shape, Cylinder) else 0.0
        made = triangles.frustum(shape.radius, top, shape.length, _SIDES)
    elif isinstance(shape, Ellipsoid):
        made = triangles.ellipsoid(shape.radii, _SIDES)
    else:
        made = triangles.joined([])
    return made.vertices, made.faces
