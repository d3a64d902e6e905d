"""The body of a model: blocks and the walls of a bitmap, stretched to the model's size."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from gazelle.errors import ResolveError
from gazelle.stage.description.devices import StageGripper
from gazelle.stage.description.models import StageBitmap, StageBlock, StageSize
from gazelle.stage.format.entity import Entity
from gazelle.stage.format.parser import find_beside, looked
from gazelle.stage.format.properties import Properties
from gazelle.stage.format.reader import Context

BOUNDARY = 0.01
"""Thickness of the walls of ``boundary`` [m]."""
MAX_POINTS = 100_000

UNIT_BLOCK = StageBlock(((-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)), (0.0, 1.0))
"""The body of a model that names none."""

Corner = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class ModelBody:
    """Body of a model."""

    blocks: tuple[StageBlock, ...] = ()
    bitmap: StageBitmap | None = None
    is_plain: bool = False  # a box, as the file names no body


def read_body(
    properties: Properties, size: StageSize, context: Context, *, solid: bool
) -> ModelBody:
    """Read the blocks, bitmap and boundary of a model, scaled to its size.

    Args:
        properties: The model's properties.
        size: Its size.
        context: Finds pictures.
        solid: Whether a model of its type has a body by default.

    Raises:
        FormatError: A block or bitmap cannot be used.
    """
    blocks = [read_block(part, properties) for part in properties.entity.parts if is_block(part)]
    blocks += _old_blocks(properties)
    bitmap = _read_bitmap(properties, context)
    bare = properties.flag("noblocks", default=False)
    plain = not blocks and bitmap is None and solid and not bare
    if plain:
        blocks = [UNIT_BLOCK]
    boundary = properties.flag("boundary", default=False)
    if not blocks and bitmap is None:
        return ModelBody()
    body = _scaled(blocks, bitmap, size)
    if boundary:
        return ModelBody((*body.blocks, *_walls(size)), body.bitmap)
    return ModelBody(body.blocks, body.bitmap, is_plain=plain)


def gripper_body(device: StageGripper, size: StageSize) -> ModelBody:
    """Return a gripper's base and its two paddles, as they are at the start."""
    length, width, height = device.paddle_size
    inwards = (0.5 - width) if device.paddles == "closed" else 0.0
    bottom = (1.0 - height) if device.lift == "up" else 0.0
    back = 1.0 - length
    return ModelBody(
        tuple(
            StageBlock(
                tuple(
                    (size.x * (x - 0.5), size.y * (y - 0.5))
                    for x, y in ((x0, y0), (x1, y0), (x1, y1), (x0, y1))
                ),
                (size.z * low, size.z * high),
            )
            for x0, x1, y0, y1, low, high in (
                (0.0, back, 0.0, 1.0, 0.0, 1.0),
                (back, 1.0, inwards, inwards + width, bottom, bottom + height),
                (back, 1.0, 1.0 - inwards - width, 1.0 - inwards, bottom, bottom + height),
            )
        )
    )


def is_block(entity: Entity) -> bool:
    """Return whether an entity in a model is a part of its body; a macro may be called block too."""
    return entity.type == "block" or (entity.word == "block" and "points" in entity.properties)


def read_block(entity: Entity, outer: Properties) -> StageBlock:
    """Read ``block ( points N point[0] [ x y ] ... z [ low high ] )``.

    Raises:
        FormatError: It has too few points, or a wrong one.
    """
    # what a model macro of that name says is of models
    own = entity.type != "block"
    properties = Properties(entity, outer.reading, outer.units, own=own)
    block = _block(properties, "", entity)
    color = properties.color()
    properties.report_unknown()
    return block if isinstance(color, str | None) else StageBlock(block.points, block.z, color)


def _block(properties: Properties, prefix: str, entity: Entity) -> StageBlock:
    count = properties.whole(f"{prefix}points", 0, least=0)
    listed = {each.name for each in properties.matching(f"{prefix}point[")}
    points: list[tuple[float, float]] = []
    if count > MAX_POINTS:
        raise entity.fail(f"a block of more than {MAX_POINTS} points")
    for index in range(count):
        name = f"{prefix}point[{index}]"
        if name in listed:
            x, y = properties.numbers(name, "ll", (0.0, 0.0))
            points.append((x, y))
    if len(points) < count or len(listed) > count:
        properties.reading.remark(
            f"'points' is {count}, but {len(listed)} are given; {len(points)} are used",
            entity.source,
        )
    if len(points) < 3:
        raise entity.fail(f"a block needs 3 points at least, found {len(points)}")
    low, high = properties.numbers(f"{prefix}z", "ll", (0.0, 1.0))
    if high < low:
        raise entity.fail(f"the top of a block is below its bottom: z is [{low:g} {high:g}]")
    return StageBlock(tuple(points), (low, high))


def _old_blocks(properties: Properties) -> list[StageBlock]:
    """Return ``blocks N block[0].points ...``, as files of Stage 3 have it."""
    count = properties.whole("blocks", 0, least=0)
    entity = properties.entity
    found = []
    for index in range(min(count, MAX_POINTS)):
        if not properties.has(f"block[{index}].points"):
            raise entity.fail(f"there is no 'block[{index}].points', and 'blocks' is {count}")
        found.append(_block(properties, f"block[{index}].", entity))
        properties.matching(f"block[{index}].")
    return found


def _read_bitmap(properties: Properties, context: Context) -> StageBitmap | None:
    uri = properties.text("bitmap")
    written = properties.get("bitmap")
    if written is None:
        return None
    if not uri:
        raise written.fail("'bitmap' names no picture")
    path = find_beside(uri, written.script, properties.reading, context.folder)
    if path is None or not path.is_file():
        raise written.fail(
            f"there is no picture '{uri}'",
            looked(uri, properties.reading, context.folder),
            ResolveError,
        )
    cells = context.pictures.load(path, written)
    rows, columns = cells.shape
    return StageBitmap(uri, path, cells, (0.0, 0.0), (float(columns), float(rows)), (0.0, 1.0))


def _scaled(blocks: Sequence[StageBlock], bitmap: StageBitmap | None, size: StageSize) -> ModelBody:
    """Return all parts, scaled so that their box is as large as the model, centred in x and y.

    Heights are scaled too, but not moved: what begins above 0 still does.
    """
    corners: list[Corner] = []
    for block in blocks:
        for z in block.z:
            corners += [(x, y, z) for x, y in block.points]
    if bitmap is not None:
        corners += [(*bitmap.low, bitmap.z[0]), (*bitmap.high, bitmap.z[1])]
    low, high = np.min(corners, axis=0), np.max(corners, axis=0)
    extent = np.where(high > low, high - low, 1.0)
    scale = np.asarray(size, np.float64) / extent
    middle = np.array([low[0] + high[0], low[1] + high[1], 0.0]) / 2.0

    def moved(x: float, y: float) -> tuple[float, float]:
        return float((x - middle[0]) * scale[0]), float((y - middle[1]) * scale[1])

    def lifted(z: tuple[float, float]) -> tuple[float, float]:
        return float(z[0] * scale[2]), float(z[1] * scale[2])

    return ModelBody(
        tuple(
            StageBlock(tuple(moved(*point) for point in block.points), lifted(block.z), block.color)
            for block in blocks
        ),
        None
        if bitmap is None
        else StageBitmap(
            bitmap.uri,
            bitmap.path,
            bitmap.cells,
            moved(*bitmap.low),
            moved(*bitmap.high),
            lifted(bitmap.z),
        ),
    )


def _walls(size: StageSize) -> list[StageBlock]:
    """Return four walls inside of the box around the body."""
    x, y = size.x / 2.0, size.y / 2.0
    thick = min(BOUNDARY, x, y)
    sides = (
        (-x, -y, -x + thick, y),
        (-x, -y, x, -y + thick),
        (-x, y - thick, x, y),
        (x - thick, -y, x, y),
    )
    return [
        StageBlock(((left, low), (right, low), (right, high), (left, high)), (0.0, size.z))
        for left, low, right, high in sides
    ]
