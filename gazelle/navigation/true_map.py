"""The true map of a world: what of it is solid at a height."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from gazelle.array_types import Bools, Floats
from gazelle.description import Model, Pose, World
from gazelle.description.occupancy import FREE, OCCUPIED, OccupancyMap
from gazelle.engines.sections import Levels, parts_of
from gazelle.errors import SimulationError
from gazelle.geometry.planar_part import PlanarPart
from gazelle.navigation.outline import links_of

_MOST_CELLS = 16_384
"""Along a side of a map; more would be gigabytes."""
_ROUNDING, _ASIDE = 1e-7, 1e-3
"""Tolerance of a point on a border of cells, and the offset to either side of it [cells]."""


def true_map(
    world: World,
    height: float = 0.2,
    *,
    resolution: float = 0.05,
    margin: float = 1.0,
    area: tuple[float, float, float, float] | None = None,
) -> OccupancyMap:
    """Return the map that a perfect survey of a world at a height would give.

    A cell is occupied where some solid has a part of it, insides of walls and furniture too; all
    others are free. Robots are left out: models with plugins or sensors that can move.

    Args:
        world: Any, of whatever format.
        height: Of the cut [m].
        resolution: Side of a cell [m].
        margin: Free ground around all that stands there [m].
        area: x and y of the lower left corner and of the upper right one [m], if not as far as
            things stand.

    Raises:
        SimulationError: The height, resolution or area is no such thing, or nothing stands at that
            height and there is no area.
    """
    if not resolution > 0.0 or not math.isfinite(height) or not margin >= 0.0:
        raise SimulationError(
            "a map needs a positive resolution, a finite height and a margin that is not negative"
        )
    outlines = [_edges(part) for part in _parts(world, height)]
    corner, shape = _extent(outlines, resolution, margin, area)
    occupied = np.zeros(shape, np.bool_)
    for edges in outlines:
        _stamp(occupied, (edges - np.tile(corner, 2)) / resolution)
    data = np.where(occupied, OCCUPIED, FREE).astype(np.int8)
    return OccupancyMap(data, resolution, Pose(float(corner[0]), float(corner[1])), name=world.name)


def _parts(world: World, height: float) -> Iterator[list[PlanarPart]]:
    """Yield the parts of solids at a height, one list for each collision, in the world frame."""
    levels = Levels((height,), height, height)
    for model in world.models:
        if not _moves(model):
            for link, pose in links_of(model, model.pose):
                for collision in link.collisions:
                    parts = parts_of(collision, pose * collision.pose, levels, moving=False)
                    cut = [part for part in parts if part.low <= height <= part.high]
                    seen = [part for part in cut if part.glow >= 0.0]
                    if seen:
                        yield seen


def _moves(model: Model) -> bool:
    """Return whether a model is a robot, not an object."""
    return not model.static and bool(model.plugins or any(link.sensors for link in model.links))


def _edges(parts: list[PlanarPart]) -> Floats:
    """Return ends of the edges of all shapes, shape (n, 4) [m]; circles as polygons."""
    rows: list[tuple[float, float, float, float]] = []
    for part in parts:
        points = _circle(part) if len(part.points) == 1 else list(part.points)
        last = len(points) if part.closed else len(points) - 1
        rows += [(*points[i], *points[(i + 1) % len(points)]) for i in range(last)]
    return np.array(rows, np.float64).reshape(-1, 4)


def _circle(part: PlanarPart) -> list[tuple[float, float]]:
    (x, y), count = part.points[0], 96
    turns = 2.0 * np.pi * np.arange(count) / count
    ring = np.stack((x + part.radius * np.cos(turns), y + part.radius * np.sin(turns)), axis=1)
    return [(float(a), float(b)) for a, b in ring]


def _extent(
    outlines: list[Floats],
    resolution: float,
    margin: float,
    area: tuple[float, float, float, float] | None,
) -> tuple[Floats, tuple[int, int]]:
    """Return the lower left corner [m], on a whole number of cells, and rows and columns."""
    if area is not None:
        low, high = np.array(area[:2], np.float64), np.array(area[2:], np.float64)
    else:
        points = np.vstack([edges.reshape(-1, 2) for edges in outlines] or [np.zeros((0, 2))])
        if not len(points):
            raise SimulationError(
                "nothing stands at that height", hint="give another height, or the area to map"
            )
        low, high = points.min(axis=0) - margin, points.max(axis=0) + margin
    cells = np.ceil((high - low) / resolution - 1e-9)
    if not np.isfinite(cells).all() or (cells < 1).any() or (cells > _MOST_CELLS).any():
        raise SimulationError(
            f"a map has 1 to {_MOST_CELLS} cells along a side, not {cells[0]:g} x {cells[1]:g}",
            hint="give another resolution, or the area to map",
        )
    corner = np.floor(low / resolution + 1e-9) * resolution
    width, height = np.ceil((high - corner) / resolution - 1e-9).astype(int)
    return corner, (int(height), int(width))


def _stamp(occupied: Bools, edges: Floats) -> None:
    """Mark the cells that edges cross as occupied, and those within by the even-odd rule."""
    _fill(occupied, edges)
    lengths = np.hypot(edges[:, 2] - edges[:, 0], edges[:, 3] - edges[:, 1])
    counts = np.ceil(4.0 * lengths).astype(int) + 1
    which = np.repeat(np.arange(len(edges)), counts)
    index = np.arange(len(which)) - np.repeat(np.cumsum(counts) - counts, counts)
    share = (index / np.maximum(counts[which] - 1, 1))[:, None]
    points = edges[which, :2] * (1.0 - share) + edges[which, 2:] * share
    on_border = (np.abs(points - np.rint(points)) < _ROUNDING).any(axis=1)
    diagonals = _ASIDE * np.array([(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)])
    beside = np.any([_taken(occupied, points + diagonal) for diagonal in diagonals], axis=0)
    # What ends exactly on the border of a cell does not reach into the next one.
    cells = np.floor(points[~(on_border & beside)]).astype(int)
    inside = ((cells >= 0) & (cells < occupied.shape[::-1])).all(axis=1)
    occupied[cells[inside, 1], cells[inside, 0]] = True


def _taken(occupied: Bools, points: Floats) -> Bools:
    """Return whether points, in cells, are in occupied ones, shape (n,)."""
    cells = np.floor(points).astype(int)
    limit = np.array(occupied.shape[::-1])
    inside = ((cells >= 0) & (cells < limit)).all(axis=1)
    x, y = np.clip(cells, 0, limit - 1).T
    taken: Bools = occupied[y, x] & inside
    return taken


def _fill(occupied: Bools, edges: Floats) -> None:
    """Mark the cells whose middles are within closed edges as occupied."""
    rows, columns = occupied.shape
    first = max(math.floor(edges[:, 1::2].min()), 0)
    last = min(math.ceil(edges[:, 1::2].max()), rows)
    for row in range(first, last):
        y = row + 0.5
        crossing = edges[(edges[:, 1] <= y) != (edges[:, 3] <= y)]
        x = crossing[:, 0] + (y - crossing[:, 1]) * (crossing[:, 2] - crossing[:, 0]) / (
            crossing[:, 3] - crossing[:, 1]
        )
        x = np.sort(x)
        for left, right in zip(x[0::2], x[1::2], strict=False):
            start, stop = math.ceil(left - 0.5), math.floor(right - 0.5) + 1
            occupied[row, max(start, 0) : min(max(stop, 0), columns)] = True
