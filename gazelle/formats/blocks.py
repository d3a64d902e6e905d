"""A body cut by level planes into blocks whose hulls fill little of the air around it.

What is judged is the air itself, in a grid: a block is cut on while its hull holds air that is
more than one cube of the grid away from the surface. So it does not matter whether a mesh is
closed, which way its faces look, or what is inside of it.
"""

from __future__ import annotations

import heapq
import itertools
import math
from dataclasses import dataclass, field

import numpy as np

from gazelle.array_types import Floats, Floats32, Ints32
from gazelle.formats.block_cuts import BlockCutter
from gazelle.formats.hull import spread_directions
from gazelle.formats.surface import WeldedSurface
from gazelle.formats.voxels import voxels_of

MOST_BLOCKS = 128

_DIRECTIONS = 162
_FACES = 32
"""Normals of the largest faces that are directions too."""
_ROUND = 50
"""Steps of a component by which normals are told apart."""
_TRIED = 300
"""Points by which a cut is judged."""
_FEWER = 5
"""Of so many directions one serves for that."""
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

    Its numbers are single: a cube of the grid is ten thousand times what that rounds by.

    Attributes:
        points: On the surface [m], shape (n, 3); some just beyond the block, so that there is
            no gap to the next.
        air: Places in the hull of the points that should not be [m], shape (k, 3).
        low: Corner [m], shape (3,).
        high: Corner [m], shape (3,).
        hull: The outermost of the points [m], shape (m, 3).
    """

    points: Floats32
    air: Floats32
    low: Floats
    high: Floats
    hull: Floats = field(default_factory=lambda: np.zeros((0, 3)))


def blocks_of(surface: WeldedSurface, side: float, *, patient: bool = True) -> Blocks | None:
    """Blocks of a surface; the worse half is cut on first.

    Args:
        surface: Any triangles.
        side: Of the cubes of the grid [m].
        patient: Whether to go on where too many would be needed, as of a vessel; else the
            result is None.
    """
    grid = voxels_of(surface, side)
    directions = _directions(surface).astype(np.float32)
    cutter = BlockCutter(directions, _FEWER, 2 * _TRIED, 4 * len(directions))
    low, high = grid.low, grid.points.max(axis=0) + 2.0 * grid.side
    queue: list[tuple[int, int, _Block]] = []
    done: list[_Block] = []
    number = itertools.count()

    def take(blocks: list[_Block]) -> None:
        for block in blocks:
            if not len(block.points):
                continue
            _enclose(block, cutter, grid.side)
            if len(block.air):
                heapq.heappush(queue, (-len(block.air), next(number), block))
            else:
                done.append(block)

    points, air = (np.array(each, np.float32, order="C") for each in (grid.points, grid.air))
    take([_Block(points, air, low, high)])
    most, asked = _HOPELESS * sum(-rank for rank, _, _ in queue), patient
    while queue and len(queue) + len(done) < MOST_BLOCKS:
        if not asked and len(queue) + len(done) >= _EARLY:
            if sum(-rank for rank, _, _ in queue) > most:
                return None
            asked = True
        room = MOST_BLOCKS - len(queue) - len(done)
        some = min(room, _TOGETHER, (len(queue) + 1) // 2)
        worst = [heapq.heappop(queue)[2] for _ in range(some)]
        parts = [(block, _cut(block, cutter, grid.side)) for block in worst]
        done += [block for block, halves in parts if not halves]
        take([half for _, halves in parts for half in halves])
    done += [block for _, _, block in queue]
    left = np.concatenate([block.air for block in done])
    return Blocks([block.hull for block in done], grid.distance(left))


def _enclose(block: _Block, cutter: BlockCutter, side: float) -> None:
    """Find the hull of a block, and which of its air is in there."""
    tops, which = cutter.tops(block.points)
    block.air = block.air[cutter.behind(block.air, tops)]
    block.hull = _thickened(block.points[np.unique(which)].astype(np.float64), side)
    if 0 < len(block.air) <= _FEW_PLACES:
        block.air = block.air[cutter.within(block.hull, block.air)]


def _cut(block: _Block, cutter: BlockCutter, side: float) -> list[_Block]:
    """The two blocks of the cut that leaves the least air in their hulls; none if too small."""
    axes, levels = _levels(block, side)
    air = _thinned(block.air)
    best = cutter.best_cut(_thinned(block.points), air, axes, levels, _EVEN * len(air))
    if best < 0:
        return []
    axis, level = int(axes[best]), float(levels[best])
    along = block.points[:, axis] - level
    parts = []
    for sign in (1.0, -1.0):
        low, high = block.low.copy(), block.high.copy()
        (high if sign > 0.0 else low)[axis] = level
        parts.append(_Block(block.points[sign * along <= side], block.air, low, high))
    return parts


def _levels(block: _Block, side: float) -> tuple[Ints32, Floats]:
    """Axes and places along them where a block may be cut: beside its air, and across it."""
    axes: list[int] = []
    levels: list[float] = []
    places = np.array([0.0, 0.25, 0.5, 0.75, 1.0]) * (len(block.air) - 1)
    under = places.astype(np.intp)
    over = np.minimum(under + 1, len(block.air) - 1)
    for axis in range(3):
        room = block.low[axis] + _LEAST * side, block.high[axis] - _LEAST * side
        if room[0] > room[1]:
            continue
        along = np.partition(block.air[:, axis], np.concatenate([under, over])).astype(np.float64)
        shares = along[under] + (along[over] - along[under]) * (places - under)
        spread = shares + side * np.array([-0.5, 0.0, 0.0, 0.0, 0.5])
        some = sorted(set(np.clip(spread, *room).tolist()))
        axes += [axis] * len(some)
        levels += some
    return np.array(axes, np.int32), np.array(levels)


def _thinned(points: Floats32) -> Floats32:
    return np.ascontiguousarray(points[:: max(1, len(points) // _TRIED)])


def _directions(surface: WeldedSurface) -> Floats:
    """Unit vectors all around, the axes and the normals of the largest faces, shape (n, 3)."""
    places = np.round(surface.normals * _ROUND).astype(np.int64) + _ROUND
    key = (places[:, 0] << 20) | (places[:, 1] << 10) | places[:, 2]
    near, inverse = np.unique(key, return_inverse=True)
    weight = np.bincount(inverse, surface.areas)
    largest = near[np.argsort(-weight, kind="stable")[:_FACES]]
    facing = np.stack([largest >> 20, largest >> 10, largest], axis=1) % 1024 - _ROUND
    facing = facing / np.linalg.norm(facing, axis=1)[:, None]
    return np.concatenate([np.eye(3), -np.eye(3), facing, spread_directions(_DIRECTIONS)])


def _thickened(points: Floats, side: float) -> Floats:
    """Points, and if they lie in a plane or on a line, so many that they have a hull."""
    arms = points - points.mean(axis=0)
    if (
        len(points) > 2
        and math.sqrt(max(np.linalg.eigvalsh(arms.T @ arms)[0], 0.0) / len(points)) > _SHEET
    ):
        return points  # no spread is more than half of the width
    _, _, axes = np.linalg.svd(arms, full_matrices=len(points) < 3)
    for axis in axes[1:]:
        if np.ptp(points @ axis) < _SHEET:
            shift = axis * min(_SHEET, 0.5 * side) / 2.0
            points = np.concatenate([points + shift, points - shift])
    return points
