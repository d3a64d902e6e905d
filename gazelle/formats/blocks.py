"""A body cut by level planes into blocks whose hulls fill little of the air around it.

What is judged is the air itself, in a grid: a block is cut on while its hull holds air that is
more than one cube of the grid away from the surface. So it does not matter whether a mesh is
closed, which way its faces look, or what is inside of it.
"""

from __future__ import annotations

import heapq
import itertools
import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Bools, Floats
from gazelle.formats.mujoco_geometry import Solid, each_hull_of
from gazelle.formats.surface import Surface
from gazelle.formats.voxels import voxels_of

Numbers: TypeAlias = NDArray[np.floating[Any]]

MOST_BLOCKS = 128

_DIRECTIONS = 162
_FACES = 32
"""Normals of the largest faces that are directions too."""
_TRIED = 300
"""Points by which a cut is judged."""
_FEWER = 5
"""Of so many directions one serves for that."""
_AT_ONCE = 24
_FEW_PLACES = 1000
"""Places in the air up to which it matters which of them are in a hull exactly."""
_TOGETHER = 16
"""Blocks that are cut in one go at most, so that their hulls are made together."""
_EARLY = 32
"""Blocks after which it is asked whether there is hope."""
_HOPELESS = 0.3
"""Air left then, as a share of what the hull of all holds, that is too much."""
_EVEN = 0.02
"""What it counts that a cut is uneven, as a share of the air."""
_LEAST = 3.0
"""Cubes that a block is long at least."""
_SINGLE = np.float32
"""Of points and air: a cube of the grid is ten thousand times what it rounds by, and it is twice as fast."""
_SHEET = 1e-3
"""Thickness of what has none [m]."""


@dataclass(frozen=True, slots=True)
class Blocks:
    """What a body was cut into.

    Attributes:
        hulls: Points of each block, whose hull it is [m], shapes (n, 3).
        gap: How far from the surface a block reaches into the air at most [m].
    """

    hulls: list[Floats]
    gap: float


@dataclass(slots=True)
class _Block:
    """What lies between two corners.

    Attributes:
        points: On the surface [m], shape (n, 3); some just beyond the block, so that there is
            no gap to the next.
        air: Places in the hull of the points that should not be [m], shape (k, 3).
        low: Corner [m], shape (3,).
        high: Corner [m], shape (3,).
        hull: The outermost of the points [m], shape (m, 3).
    """

    points: Numbers
    air: Numbers
    low: Floats
    high: Floats
    hull: Floats = field(default_factory=lambda: np.zeros((0, 3)))


def blocks_of(surface: Surface, side: float, *, patient: bool = True) -> Blocks | None:
    """Blocks of a surface; the worse half is cut on first.

    Args:
        surface: Any triangles.
        side: Of the cubes of the grid [m].
        patient: Whether to go on where too many would be needed, as of a vessel; else the
            result is None.
    """
    grid = voxels_of(surface, side)
    directions = _directions(surface).astype(_SINGLE)
    low, high = grid.low, grid.points.max(axis=0) + 2.0 * grid.side
    queue: list[tuple[int, int, _Block]] = []
    done: list[_Block] = []
    number = itertools.count()

    def take(blocks: list[_Block]) -> None:
        blocks = [block for block in blocks if len(block.points)]
        _enclose(blocks, directions, grid.side)
        for block in blocks:
            if len(block.air):
                heapq.heappush(queue, (-len(block.air), next(number), block))
            else:
                done.append(block)

    take([_Block(grid.points.astype(_SINGLE), grid.air.astype(_SINGLE), low, high)])
    most, asked = _HOPELESS * sum(-rank for rank, _, _ in queue), patient
    while queue and len(queue) + len(done) < MOST_BLOCKS:
        if not asked and len(queue) + len(done) >= _EARLY:
            if sum(-rank for rank, _, _ in queue) > most:
                return None
            asked = True
        room = MOST_BLOCKS - len(queue) - len(done)
        some = min(room, _TOGETHER, (len(queue) + 1) // 2)
        worst = [heapq.heappop(queue)[2] for _ in range(some)]
        parts = [(block, _cut(block, grid.side, directions)) for block in worst]
        done += [block for block, halves in parts if not halves]
        take([half for _, halves in parts for half in halves])
    done += [block for _, _, block in queue]
    air = np.concatenate([block.air for block in done])
    return Blocks([block.hull for block in done], grid.distance(air))


def _enclose(blocks: list[_Block], directions: Numbers, side: float) -> None:
    """Find the hulls of blocks, and which of their air is in there."""
    unsure = []
    for block in blocks:
        along = directions @ block.points.T
        top = along.argmax(axis=1)
        low, high = block.points.min(axis=0), block.points.max(axis=0)
        near = block.air[((block.air >= low) & (block.air <= high)).all(axis=1)]
        block.air = near[_behind(near, directions, along[np.arange(len(top)), top])]
        block.hull = _thickened(block.points[np.unique(top)].astype(np.float64), side)
        if 0 < len(block.air) <= _FEW_PLACES:
            unsure.append(block)
    hulls = each_hull_of([block.hull for block in unsure])
    for block, hull in zip(unsure, hulls, strict=True):
        block.air = block.air[_held(hull, block.air)]


def _cut(block: _Block, side: float, directions: Numbers) -> list[_Block]:
    """The two blocks of the cut that leaves the least air in their hulls; none if too small."""
    some, points, air = directions[::_FEWER], _thinned(block.points), _thinned(block.air)
    points_along, air_along = some @ points.T, some @ air.T
    best: tuple[float, int, float] | None = None
    for axis, levels in _levels(block, side):
        order = np.argsort(points[:, axis])
        along = points_along[:, order]
        reach = np.maximum.accumulate(along, axis=1)  # of all points below each
        rest = np.maximum.accumulate(along[:, ::-1], axis=1)[:, ::-1]
        counts = np.searchsorted(points[order, axis], levels, side="right")
        for level, count in zip(levels, counts.tolist(), strict=True):
            if count in {0, len(order)}:
                continue
            held = (air_along <= reach[:, count - 1, None]).all(axis=0)
            held |= (air_along <= rest[:, count, None]).all(axis=0)
            cost = float(held.sum()) + _EVEN * len(air) * abs(count / len(order) - 0.5)
            if best is None or cost < best[0]:
                best = (cost, axis, level)
    if best is None:
        return []
    _, axis, level = best
    parts = []
    for sign in (1.0, -1.0):
        near = sign * (block.points[:, axis] - level) <= side
        low, high = block.low.copy(), block.high.copy()
        (high if sign > 0.0 else low)[axis] = level
        parts.append(_Block(block.points[near], block.air, low, high))
    return parts


def _levels(block: _Block, side: float) -> Iterator[tuple[int, list[float]]]:
    """Axes and places along them where a block may be cut: beside its air, and across it."""
    shares = np.quantile(block.air, (0.0, 0.25, 0.5, 0.75, 1.0), axis=0)
    for axis in range(3):
        room = block.low[axis] + _LEAST * side, block.high[axis] - _LEAST * side
        if room[0] > room[1]:
            continue
        spread = shares[:, axis] + side * np.array([-0.5, 0.0, 0.0, 0.0, 0.5])
        yield axis, sorted(set(np.clip(spread, *room).tolist()))


def _held(hull: Solid | None, air: Numbers) -> Bools:
    """Which places in the air lie in a hull, shape (k,)."""
    if hull is None:
        return np.zeros(len(air), bool)
    corners, faces = hull
    a, b, c = (corners[faces[:, i]] for i in range(3))
    normals = np.cross(b - a, c - a)
    order = np.argsort(-np.einsum("ij,ij->i", normals, normals))
    return _behind(air, normals[order], np.einsum("ij,ij->i", normals, a)[order])


def _behind(air: Numbers, normals: Numbers, offsets: Numbers) -> Bools:
    """Which places lie behind all of some planes, shape (k,)."""
    held = np.ones(len(air), bool)
    for start in range(0, len(normals), _AT_ONCE):
        rows = np.flatnonzero(held)
        if not len(rows):
            break
        part = slice(start, start + _AT_ONCE)
        held[rows] = (normals[part] @ air[rows].T <= offsets[part, None]).all(axis=0)
    return held


def _thinned(points: Numbers) -> Numbers:
    return points[:: max(1, len(points) // _TRIED)]


def _directions(surface: Surface) -> Floats:
    """Unit vectors all around, the axes and the normals of the largest faces, shape (n, 3)."""
    turn = math.pi * (3.0 - math.sqrt(5.0)) * np.arange(_DIRECTIONS)
    z = 1.0 - (2.0 * np.arange(_DIRECTIONS) + 1.0) / _DIRECTIONS
    ring = np.sqrt(1.0 - z * z)
    around = np.stack([ring * np.cos(turn), ring * np.sin(turn), z], axis=1)
    near, inverse = np.unique(np.round(surface.normals * 50.0), axis=0, return_inverse=True)
    weight = np.bincount(inverse.ravel(), surface.areas)
    largest = near[np.argsort(-weight, kind="stable")[:_FACES]]
    largest /= np.linalg.norm(largest, axis=1)[:, None]
    return np.concatenate([np.eye(3), -np.eye(3), largest, around])


def _thickened(points: Floats, side: float) -> Floats:
    """Points, and if they lie in a plane or on a line, so many that they have a hull."""
    _, _, axes = np.linalg.svd(points - points.mean(axis=0), full_matrices=len(points) < 3)
    for axis in axes[1:]:
        if np.ptp(points @ axis) < _SHEET:
            shift = axis * min(_SHEET, 0.5 * side) / 2.0
            points = np.concatenate([points + shift, points - shift])
    return points
