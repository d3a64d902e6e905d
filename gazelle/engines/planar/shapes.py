"""Outlines of things in the plane, and the tables that kernels read them from."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from gazelle.argument_checks import checked
from gazelle.array_types import Bools, Floats
from gazelle.engines.planar import columns as c
from gazelle.errors import EngineError
from gazelle.geometry.planar_part import PlanarPart
from gazelle.geometry.polygons import Point, ccw, convex


@checked(EngineError)
@dataclass(frozen=True, slots=True)
class Raster:
    """A bitmap that some primitives are the outline of.

    Attributes:
        cells: Mask of solid cells, the lowest row first.
        low: Lower left corner in the bitmap's frame [m].
        cell: Width and depth of a cell [m].
        pose: x, y [m] and heading [rad] of the frame.
        z: Lowest and highest height [m].
        first: The first of its primitives.
        last: The one after its last.
    """

    cells: NDArray[np.bool_]
    low: Point
    cell: Point
    pose: tuple[float, float, float]
    z: tuple[float, float]
    first: int
    last: int


@checked(EngineError, most=math.inf)
@dataclass(frozen=True, slots=True)
class PrimitiveTable:
    """Primitives that rays meet, and the tags of the parts they are of.

    Attributes:
        rows: Shape (n, PRIMITIVE).
        tags: Shape (n,).
        raster: The largest bitmap among them, if there is one.

    Raises:
        EngineError: The shapes do not fit, or a number is invalid.
    """

    rows: Floats
    tags: NDArray[np.int64]
    raster: Raster | None = None

    def __post_init__(self) -> None:
        if self.rows.shape != (len(self.tags), c.PRIMITIVE):
            raise EngineError(
                f"primitives need rows of {c.PRIMITIVE} numbers and as many tags, not shapes "
                f"{self.rows.shape} and {self.tags.shape}"
            )

    @property
    def segments(self) -> Floats:
        """Ends of the segments [m], shape (n, 4)."""
        found: Floats = self.rows[~self._round][:, [c.X0, c.Y0, c.X1, c.Y1]]
        return found

    @property
    def discs(self) -> Floats:
        """Middles and radii of the circles [m], shape (n, 3)."""
        found: Floats = self.rows[self._round][:, [c.X0, c.Y0, c.X1]]
        return found

    @property
    def _round(self) -> Bools:
        return np.asarray((self.rows[:, c.KIND].astype(int) & int(c.CIRCLE)) != 0)

    def between(self, low: float, high: float) -> PrimitiveTable:
        """Return the primitives with a part above one height and below another [m]."""
        kept = (self.rows[:, c.LOW] < high) & (self.rows[:, c.HIGH] > low)
        return PrimitiveTable(self.rows[kept], self.tags[kept])


@checked(EngineError, most=math.inf)
def segments_of(
    lines: Floats, z: tuple[float, float], *, glow: float, solid: bool
) -> PrimitiveTable:
    """Return the segments of a closed outline.

    Args:
        lines: x0, y0, x1, y1 [m], shape (n, 4).
        z: Lowest and highest height [m].
        glow: As of a ``PlanarPart``.
        solid: Whether bodies collide with it.

    Raises:
        EngineError: A line has more or fewer numbers, or one that is impossible.
    """
    lines = np.asarray(lines, np.float64)
    if lines.ndim != 2 or lines.shape[1] != 4:  # x0, y0, x1, y1
        raise EngineError(f"lines must have the shape (n, 4), not {lines.shape}")
    rows = np.zeros((len(lines), c.PRIMITIVE))
    rows[:, c.X0 : c.Y1 + 1] = lines
    rows[:, c.LOW], rows[:, c.HIGH] = z
    rows[:, c.GLOW] = glow
    rows[:, c.KIND] = c.SEGMENT if solid else c.SEGMENT + c.GHOST
    return PrimitiveTable(rows, np.zeros(len(rows), np.int64))


def joined(first: PrimitiveTable, second: PrimitiveTable) -> PrimitiveTable:
    """Return the primitives of two tables; the raster is that of the first, if it has one."""
    if not len(second.rows):
        return first
    rows, tags = np.vstack((first.rows, second.rows)), np.concatenate((first.tags, second.tags))
    return PrimitiveTable(rows, tags, first.raster)


@dataclass(frozen=True, slots=True)
class CollisionPieces:
    """Convex pieces that bump, and their corners.

    Attributes:
        rows: Shape (n, PIECE).
        corners: Shape (m, 2).
    """

    rows: Floats
    corners: Floats


@dataclass(slots=True)
class _Rows:
    rows: list[Floats] = field(default_factory=list)
    tags: list[NDArray[np.int64]] = field(default_factory=list)


@checked(EngineError)
def primitives_of(parts: Iterable[PlanarPart]) -> PrimitiveTable:
    """Return the segments and circles of parts.

    Raises:
        EngineError: A part has too few corners, or a value is not finite.
    """
    found = _Rows()
    for part in parts:
        points = np.asarray(part.points, np.float64).reshape(-1, 2)
        check(part, points)
        if part.radius > 0.0:
            lines = np.array([[*points[0], part.radius, 0.0]])
        else:
            ring = ccw(points) if part.closed else points
            ends = np.roll(ring, -1, axis=0) if part.closed else ring[1:]
            lines = np.hstack((ring if part.closed else ring[:-1], ends))
        kind = c.CIRCLE if part.radius > 0.0 else c.SEGMENT
        kind += (0 if part.solid else c.GHOST) + (0 if part.closed else c.OPEN)
        same = np.tile([part.low, part.high, part.glow, kind], (len(lines), 1))
        found.rows.append(np.hstack((lines, same)))
        found.tags.append(np.full(len(lines), part.tag))
    if not found.rows:
        return PrimitiveTable(np.zeros((0, c.PRIMITIVE)), np.zeros(0, np.int64))
    return PrimitiveTable(np.vstack(found.rows), np.concatenate(found.tags).astype(np.int64))


def pieces_of(parts: Iterable[PlanarPart]) -> CollisionPieces:
    """Return the convex pieces of the solid parts; open lines collide with nothing."""
    rows: list[list[float]] = []
    corners: list[Floats] = []
    for part in parts:
        points = np.asarray(part.points, np.float64).reshape(-1, 2)
        check(part, points)
        if not part.solid or (part.radius == 0.0 and not part.closed):
            continue
        if part.radius > 0.0:
            x, y = points[0]
            rows.append([x, y, part.radius, part.low, part.high, 0.0, 0.0, part.radius])
            continue
        for polygon in convex(ccw(points)):
            middle = (polygon.min(axis=0) + polygon.max(axis=0)) / 2.0
            bound = float(np.linalg.norm(polygon - middle, axis=1).max())
            first = sum(map(len, corners))
            slim = slimness(polygon)
            rows.append([*middle, bound, part.low, part.high, first, len(polygon), slim])
            corners.append(polygon)
    return CollisionPieces(
        np.array(rows).reshape(-1, c.PIECE),
        np.vstack(corners) if corners else np.zeros((0, 2)),
    )


def check(part: PlanarPart, points: Floats) -> None:
    """Check the shape of a part.

    Raises:
        EngineError: It has too few corners, or a value is not finite.
    """
    least = 1 if part.radius > 0.0 else 3 if part.closed else 2
    if len(points) < least or not np.isfinite(points).all() or not math.isfinite(part.radius):
        raise EngineError(f"an outline needs at least {least} finite corners, not {part.points}")


def slimness(polygon: Floats) -> float:
    """Return the distance from the mean corner of a convex polygon to its nearest side [m]."""
    along = np.roll(polygon, -1, axis=0) - polygon
    arm = polygon.mean(axis=0) - polygon
    aside = np.abs(along[:, 0] * arm[:, 1] - along[:, 1] * arm[:, 0])
    length = np.hypot(along[:, 0], along[:, 1])
    return float((aside / np.maximum(length, 1e-300)).min())
