"""Appearance of Stage's models to cameras: their bodies in their colours, and the ground."""

from __future__ import annotations

import colorsys
import math
import zlib
from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from gazelle.array_types import Floats, Ints64
from gazelle.description import Color
from gazelle.formats.terrain import rectangles
from gazelle.geometry.triangles import TriangleMesh, quadrangles
from gazelle.rendering.painted import PaintedPart, painted_world
from gazelle.rendering.visible import VisibleWorld
from gazelle.stage.description import (
    PlacedStageModel,
    StageBitmap,
    StageCamera,
    StageModel,
    StagePose,
)
from gazelle.stage.faces import NO_FACES, in_tiles, plates, prism, walls_between
from gazelle.stage.shapes import bitmap_lines, blocks_of

Rgb = tuple[float, float, float]

SKY = (179.0 / 255.0, 179.0 / 255.0, 204.0 / 255.0, 1.0)
"""Background colour."""

_FLOOR = (1.0, 1.0, 1.0)
_FAR = 1e7
"""Extent of the ground [m], limited so that its heights are exact to a nanometre."""
_TILE = 64
"""Faces of what stands still that a camera leaves out together."""


@dataclass(frozen=True, slots=True)
class StageScenery:
    """All that can be seen, on links: the first stands still, the others are on bodies.

    Attributes:
        seen: Drawn models.
        bodies: Of each link but the first its parent body, shape (nlink - 1,).
        casings: Links of models with cameras, by body and by their number on it, depth first:
            a camera does not see its own.
    """

    seen: VisibleWorld
    bodies: Ints64
    casings: dict[tuple[int, int], int]


@dataclass(frozen=True, slots=True)
class _BodyLook:
    """Appearance of a body: of the owners that have a link of their own, and of all others (-1)."""

    parts: tuple[tuple[int, TriangleMesh, Rgb], ...]
    casings: tuple[int, ...]


def color_of(model: StageModel) -> Color:
    """Return the colour of a model; a random one depends on its name only."""
    if model.color != "random":
        return model.color
    hue = zlib.crc32(model.name.encode()) / 2**32
    return (*colorsys.hsv_to_rgb(hue, 0.7, 0.8), 1.0)


def scenery_of(still_ones: Iterable[StageModel], bodies: Sequence[StageModel]) -> StageScenery:
    """Return the scenery of a world.

    Args:
        still_ones: Models that never move.
        bodies: The model of each moving body, with all that is on it.
    """
    still = [placed for model in still_ones for placed in model.walk()]
    parts = [PaintedPart(0, _ground(), _FLOOR)]
    for color, faces in _by_color(still).items():
        parts += [PaintedPart(0, quadrangles(tile), color) for tile in in_tiles(faces, _TILE)]
    links, carriers, casings = ["still"], list[int](), dict[tuple[int, int], int]()
    known: dict[tuple[int, ...], _BodyLook] = {}
    for body, model in enumerate(bodies):
        # the same for all of one macro, unless their colours are of their own
        key = (id(model.blocks), id(model.children), hash(color_of(model)))
        if key not in known:
            known[key] = _look_of(model)
        here = {-1: len(links)}
        here.update((own, len(links) + 1 + k) for k, own in enumerate(known[key].casings))
        casings.update(((body, own), here[own]) for own in known[key].casings)
        links += [f"{body}" if own < 0 else f"{body}.{own}" for own in here]
        carriers += [body] * len(here)
        parts += [PaintedPart(here[own], mesh, color) for own, mesh, color in known[key].parts]
    return StageScenery(painted_world(links, parts), np.array(carriers, np.int64), casings)


def _look_of(model: StageModel) -> _BodyLook:
    """Return a model and all on it in its frame."""
    placed = list(replace(model, pose=StagePose()).walk())
    cameras = tuple(k for k, p in enumerate(placed) if p.model.device_of(StageCamera) is not None)
    groups = {-1: [p for k, p in enumerate(placed) if k not in cameras]}
    groups |= {k: [placed[k]] for k in cameras}
    return _BodyLook(
        tuple(
            (own, quadrangles(faces), color)
            for own, group in groups.items()
            for color, faces in _by_color(group).items()
        ),
        cameras,
    )


def _by_color(models: Iterable[PlacedStageModel]) -> dict[Rgb, Floats]:
    """Return all faces of some models by their colours, where the models are placed."""
    found: defaultdict[Rgb, list[Floats]] = defaultdict(lambda: [NO_FACES])
    for placed in models:
        for color, faces in _faces_of(placed):
            found[color].append(faces)
    return {color: np.vstack(faces) for color, faces in found.items()}


def _faces_of(placed: PlacedStageModel) -> Iterator[tuple[Rgb, Floats]]:
    own = _paint(color_of(placed.model))
    for block, part in zip(placed.model.blocks, blocks_of(placed), strict=True):
        color = own if block.color is None else _paint(block.color)
        yield color, prism(part.points, part.low, part.high)
    bitmap, frame = placed.model.bitmap, placed.body_pose
    if bitmap is not None:
        low, high = frame.z + bitmap.z[0], frame.z + bitmap.z[1]
        yield own, walls_between(bitmap_lines(bitmap, frame), low, high)
        yield own, plates(_tops(bitmap, frame), high)


def _tops(bitmap: StageBitmap, frame: StagePose) -> Floats:
    """Return the corners of rectangles that cover the walls of a bitmap, shape (n, 4, 2)."""
    boxes = rectangles(bitmap.cells).reshape(-1, 4)
    corners = boxes[:, [0, 1, 2, 1, 2, 3, 0, 3]].reshape(-1, 2) * bitmap.cell_size + bitmap.low
    cos, sin = np.cos(frame.yaw), np.sin(frame.yaw)
    turn = np.array([[cos, sin], [-sin, cos]])
    quads: Floats = (corners @ turn + (frame.x, frame.y)).reshape(-1, 4, 2)
    return quads


def _paint(color: Color) -> Rgb:
    """Return a colour as bytes, red, green and blue."""
    red, green, blue = (round(255.0 * part) / 255.0 for part in color[:3])
    return red, green, blue


def _ground() -> TriangleMesh:
    """Return the ground at height zero: one triangle, so that no edge is in view."""
    angles = np.array([0.0, 2.0, 4.0, 4.0]) * math.pi / 3.0
    return quadrangles(plates(_FAR * np.stack((np.cos(angles), np.sin(angles)), axis=1)[None], 0.0))
