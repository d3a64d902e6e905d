"""Outlines of Stage's models: their blocks, and the walls of their bitmaps."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

import numpy as np

from gazelle.array_types import Floats
from gazelle.formats.terrain import rectangles
from gazelle.geometry.bitmap_outline import bitmap_outline
from gazelle.geometry.planar_part import PlanarPart
from gazelle.stage.description import (
    PlacedStageModel,
    StageBitmap,
    StagePose,
)

_TOUCH = 1e-9
"""In Stage bodies meet, and sensors see, also at the very heights where bodies end [m]."""


def parts_of(placed: PlacedStageModel) -> Iterator[PlanarPart]:
    """Yield the blocks of one model, and the walls of its bitmap as rectangles."""
    yield from blocks_of(placed)
    frame, returns = placed.body_pose, placed.model.returns
    bitmap = placed.model.bitmap
    if bitmap is None:
        return
    width, depth = bitmap.cell_size
    x, y = bitmap.low
    low_z, high_z = heights_of(frame, bitmap.z)
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
    """Yield the blocks of one model."""
    frame, returns = placed.body_pose, placed.model.returns
    for block in placed.model.blocks:
        low_z, high_z = heights_of(frame, block.z)
        yield PlanarPart(
            _turned(frame, block.points),
            low=low_z,
            high=high_z,
            glow=returns.ranger,
            solid=returns.obstacle,
        )


def bitmap_lines(bitmap: StageBitmap, frame: StagePose) -> Floats:
    """Return the outline of a bitmap at the pose of its body: x0, y0, x1, y1 [m], shape (n, 4)."""
    width, depth = bitmap.cell_size
    points = bitmap_outline(bitmap.cells).reshape(-1, 2) * (width, depth) + bitmap.low
    cos, sin = math.cos(frame.yaw), math.sin(frame.yaw)
    turn = np.array([[cos, sin], [-sin, cos]])
    lines: Floats = (points @ turn + (frame.x, frame.y)).reshape(-1, 4)
    return lines


def heights_of(frame: StagePose, z: tuple[float, float]) -> tuple[float, float]:
    """Return the lowest and highest point of a body in the world [m], a little beyond the file's."""
    return frame.z + z[0] - _TOUCH, frame.z + z[1] + _TOUCH


def _turned(
    frame: StagePose, points: Iterable[tuple[float, float]]
) -> tuple[tuple[float, float], ...]:
    cos, sin = math.cos(frame.yaw), math.sin(frame.yaw)
    return tuple((frame.x + cos * x - sin * y, frame.y + sin * x + cos * y) for x, y in points)
