"""What Stage's models look like: the faces of their bodies, in their colours."""

from __future__ import annotations

import colorsys
import zlib
from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np

from gazelle.array_types import Floats
from gazelle.description import (
    Color,
    PlacedStageModel,
    StageBitmap,
    StageModel,
    StagePose,
)
from gazelle.engines.planar.picture_columns import FACE
from gazelle.engines.planar.pictures import Rgb, Scenery, plates, prism, walls_between
from gazelle.engines.planar.stage_walls import bitmap_lines, blocks_of
from gazelle.formats.terrain import rectangles

_STILL = -1
"""Owner of all faces that are on no robot."""


def color_of(model: StageModel) -> Color:
    """Its colour; of one of any colour always the same for its name."""
    if model.color != "random":
        return model.color
    hue = zlib.crc32(model.name.encode()) / 2**32
    return (*colorsys.hsv_to_rgb(hue, 0.7, 0.8), 1.0)


def scenery_of(still_ones: Iterable[StageModel], bodies: Sequence[StageModel]) -> Scenery:
    """The faces of a world.

    Args:
        still_ones: Models that never move.
        bodies: The model of each moving body, with all that is on it.
    """
    still = [faces_of(placed, _STILL) for model in still_ones for placed in model.walk()]
    known: dict[tuple[int, ...], Floats] = {}
    looks = []
    for model in bodies:
        # the same for all of one macro, unless their colours are of their own
        key = (id(model.blocks), id(model.children), hash(color_of(model)))
        if key not in known:
            known[key] = _look_of(model)
        looks.append(known[key])
    return Scenery(np.vstack([np.zeros((0, FACE)), *still]), looks)


def _look_of(model: StageModel) -> Floats:
    """A model and all on it in its frame; owners count them."""
    placed = replace(model, pose=StagePose()).walk()
    return np.vstack([np.zeros((0, FACE)), *(faces_of(p, k) for k, p in enumerate(placed))])


def faces_of(placed: PlacedStageModel, owner: int) -> Floats:
    """The faces of one model, where it is placed, shape (n, FACE)."""
    own = _bytes(color_of(placed.model))
    found = [np.zeros((0, FACE))]
    for block, part in zip(placed.model.blocks, blocks_of(placed), strict=True):
        color = own if block.color is None else _bytes(block.color)
        found.append(prism(part.points, part.low, part.high, color, owner))
    bitmap, frame = placed.model.bitmap, placed.body_pose
    if bitmap is not None:
        low, high = frame.z + bitmap.z[0], frame.z + bitmap.z[1]
        found.append(walls_between(bitmap_lines(bitmap, frame), low, high, own, owner))
        found.append(plates(_tops(bitmap, frame), high, own, owner))
    return np.vstack(found)


def _tops(bitmap: StageBitmap, frame: StagePose) -> Floats:
    """The corners of rectangles that cover the walls of a bitmap, shape (n, 4, 2)."""
    boxes = rectangles(bitmap.cells).reshape(-1, 4)
    corners = boxes[:, [0, 1, 2, 1, 2, 3, 0, 3]].reshape(-1, 2) * bitmap.cell_size + bitmap.low
    cos, sin = np.cos(frame.yaw), np.sin(frame.yaw)
    turn = np.array([[cos, sin], [-sin, cos]])
    quads: Floats = (corners @ turn + (frame.x, frame.y)).reshape(-1, 4, 2)
    return quads


def _bytes(color: Color) -> Rgb:
    red, green, blue = (float(round(255.0 * part)) for part in color[:3])
    return red, green, blue
