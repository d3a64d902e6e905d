"""Static primitives of Stage's models."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from gazelle.array_types import Floats
from gazelle.description import PlacedStageModel, StageBitmap
from gazelle.engines.planar import columns as c
from gazelle.engines.planar.shapes import PrimitiveTable, Raster, primitives_of
from gazelle.engines.stage_shapes import bitmap_lines, blocks_of, heights_of
from gazelle.geometry.planar_part import PlanarPart


def table_of(models: Iterable[PlacedStageModel]) -> PrimitiveTable:
    """Return the primitives of static models; of bitmaps only their outlines."""
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
    return PrimitiveTable(all_rows, np.zeros(len(all_rows), np.int64), raster)


def _raster_of(placed: PlacedStageModel, bitmap: StageBitmap, first: int, last: int) -> Raster:
    frame = placed.body_pose
    pose = (frame.x, frame.y, frame.yaw)
    return Raster(
        bitmap.cells, bitmap.low, bitmap.cell_size, pose, heights_of(frame, bitmap.z), first, last
    )


def _outline_rows(placed: PlacedStageModel, bitmap: StageBitmap) -> Floats:
    frame, returns = placed.body_pose, placed.model.returns
    lines = bitmap_lines(bitmap, frame)
    rows = np.zeros((len(lines), c.PRIMITIVE))
    rows[:, c.X0 : c.Y1 + 1] = lines
    rows[:, c.LOW], rows[:, c.HIGH] = heights_of(frame, bitmap.z)
    rows[:, c.GLOW] = returns.ranger
    rows[:, c.KIND] = c.SEGMENT if returns.obstacle else c.SEGMENT + c.GHOST
    return rows
