"""Static primitives of Stage's models."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from gazelle.engines.planar import PrimitiveTable, Raster, primitives_of, segments_of
from gazelle.geometry.planar_part import PlanarPart
from gazelle.stage.description import PlacedStageModel, StageBitmap
from gazelle.stage.shapes import bitmap_lines, blocks_of, heights_of


def table_of(models: Iterable[PlacedStageModel]) -> PrimitiveTable:
    """Return the primitives of static models; of bitmaps only their outlines."""
    parts: list[PlanarPart] = []
    pictures: list[tuple[PlacedStageModel, StageBitmap]] = []
    for placed in models:
        if placed.model.bitmap is not None:
            pictures.append((placed, placed.model.bitmap))
        parts += blocks_of(placed)
    tables = [primitives_of(parts), *(_outline(placed, bitmap) for placed, bitmap in pictures)]
    raster, first = None, len(tables[0].rows)
    for (placed, bitmap), own in zip(pictures, tables[1:], strict=True):
        seen, last = placed.model.returns.ranger >= 0.0, first + len(own.rows)
        if seen and (raster is None or bitmap.cells.size > raster.cells.size):
            raster = _raster_of(placed, bitmap, first, last)
        first = last
    rows = np.vstack([table.rows for table in tables])
    return PrimitiveTable(rows, np.zeros(len(rows), np.int64), raster)


def _raster_of(placed: PlacedStageModel, bitmap: StageBitmap, first: int, last: int) -> Raster:
    frame = placed.body_pose
    pose = (frame.x, frame.y, frame.yaw)
    return Raster(
        bitmap.cells, bitmap.low, bitmap.cell_size, pose, heights_of(frame, bitmap.z), first, last
    )


def _outline(placed: PlacedStageModel, bitmap: StageBitmap) -> PrimitiveTable:
    frame, returns = placed.body_pose, placed.model.returns
    lines, z = bitmap_lines(bitmap, frame), heights_of(frame, bitmap.z)
    return segments_of(lines, z, glow=returns.ranger, solid=returns.obstacle)
