"""What of Stage's bodies stops rays and robots, as the planar engine takes it."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats
from gazelle.description import PlacedStageModel, StageBitmap, StagePose
from gazelle.engines.planar import columns as c
from gazelle.engines.planar.shapes import Raster, Table, primitives_of
from gazelle.formats.terrain import rectangles
from gazelle.geometry.planar_part import PlanarPart

_TOUCH = 1e-9
"""In Stage bodies meet, and sensors see, also at the very heights where bodies end [m]."""


def parts_of(placed: PlacedStageModel) -> Iterator[PlanarPart]:
    """The blocks of one model, and the walls of its bitmap as rectangles."""
    yield from blocks_of(placed)
    frame, returns = placed.body_pose, placed.model.returns
    bitmap = placed.model.bitmap
    if bitmap is None:
        return
    width, depth = bitmap.cell_size
    x, y = bitmap.low
    low_z, high_z = _heights(frame, bitmap.z)
    for left, low, right, high in rectangles(bitmap.cells).tolist():
        x0, x1, y0, y1 = x + left * width, x + right * width, y + low * depth, y + high * depth
        yield PlanarPart(
            _turned(frame, ((x0, y0), (x1, y0), (x1, y1), (x0, y1))),
            low=low_z,
            high=high_z,
            glow=returns.ranger,
            solid=returns.obstacle,
        )


def blocks_of(placed: PlacedStageModel) -> Iterator[PlanarPart]:
    """The blocks of one model."""
    frame, returns = placed.body_pose, placed.model.returns
    for block in placed.model.blocks:
        low_z, high_z = _heights(frame, block.z)
        yield PlanarPart(
            _turned(frame, block.points),
            low=low_z,
            high=high_z,
            glow=returns.ranger,
            solid=returns.obstacle,
        )


def _heights(frame: StagePose, z: tuple[float, float]) -> tuple[float, float]:
    """From where to where a body reaches in the world [m], a touch farther than it says."""
    return frame.z + z[0] - _TOUCH, frame.z + z[1] + _TOUCH


def table_of(models: Iterable[PlacedStageModel]) -> Table:
    """The primitives of models that stand still; of bitmaps only their outlines."""
    parts: list[PlanarPart] = []
    pictures: list[tuple[PlacedStageModel, StageBitmap]] = []
    for placed in models:
        if placed.model.bitmap is not None:
            pictures.append((placed, placed.model.bitmap))
        parts += blocks_of(placed)
    plain = primitives_of(parts)
    rows = [plain.rows, *(_outline_rows(placed, bitmap) for placed, bitmap in pictures)]
    all_rows, raster, first = np.vstack(rows), None, len(plain.rows)
    for (placed, bitmap), own in zip(pictures, rows[1:], strict=True):
        seen = placed.model.returns.ranger >= 0.0
        if seen and (raster is None or bitmap.cells.size > raster.cells.size):
            raster = _raster_of(placed, bitmap, first, first + len(own))
        first += len(own)
    return Table(all_rows, np.zeros(len(all_rows), np.int64), raster)


def _raster_of(placed: PlacedStageModel, bitmap: StageBitmap, first: int, last: int) -> Raster:
    frame = placed.body_pose
    pose = (frame.x, frame.y, frame.yaw)
    return Raster(
        bitmap.cells, bitmap.low, bitmap.cell_size, pose, _heights(frame, bitmap.z), first, last
    )


def outline(cells: NDArray[np.bool_]) -> NDArray[np.int64]:
    """The longest segments around the true cells, those on their left; x0, y0, x1, y1.

    In cells from the lower left corner of the first, shape (n, 4).
    """
    level = _runs(cells)
    upright = _runs(np.ascontiguousarray(cells.T))[:, [1, 0, 3, 2]]
    # seen from the other side left and right change places
    return np.vstack([level, upright[:, [2, 3, 0, 1]]])


def _runs(cells: NDArray[np.bool_]) -> NDArray[np.int64]:
    """The edges between rows, joined where they go on."""
    framed = np.pad(cells, 1).astype(np.int8)
    change = np.diff(framed, axis=0)  # 1: a wall begins above the edge, -1: it ends
    found = []
    for sign in (1, -1):
        steps = np.diff((change == sign).view(np.int8), axis=1)
        rows, starts = np.nonzero(steps == 1)
        ends = np.nonzero(steps == -1)[1]
        first, last = (starts, ends) if sign == 1 else (ends, starts)
        found.append(np.stack([first, rows, last, rows], axis=1))
    return np.vstack(found).astype(np.int64)


def bitmap_lines(bitmap: StageBitmap, frame: StagePose) -> Floats:
    """The outline of a bitmap whose body has a pose: x0, y0, x1, y1 [m], shape (n, 4)."""
    width, depth = bitmap.cell_size
    points = outline(bitmap.cells).reshape(-1, 2) * (width, depth) + bitmap.low
    cos, sin = math.cos(frame.yaw), math.sin(frame.yaw)
    turn = np.array([[cos, sin], [-sin, cos]])
    lines: Floats = (points @ turn + (frame.x, frame.y)).reshape(-1, 4)
    return lines


def _outline_rows(placed: PlacedStageModel, bitmap: StageBitmap) -> Floats:
    frame, returns = placed.body_pose, placed.model.returns
    lines = bitmap_lines(bitmap, frame)
    rows = np.zeros((len(lines), c.PRIMITIVE))
    rows[:, c.X0 : c.Y1 + 1] = lines
    rows[:, c.LOW], rows[:, c.HIGH] = _heights(frame, bitmap.z)
    rows[:, c.GLOW] = returns.ranger
    rows[:, c.KIND] = c.SEGMENT if returns.obstacle else c.SEGMENT + c.GHOST
    return rows


def _turned(
    frame: StagePose, points: Iterable[tuple[float, float]]
) -> tuple[tuple[float, float], ...]:
    cos, sin = math.cos(frame.yaw), math.sin(frame.yaw)
    return tuple((frame.x + cos * x - sin * y, frame.y + sin * x + cos * y) for x, y in points)
