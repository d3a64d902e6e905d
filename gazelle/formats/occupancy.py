"""Maps of ROS's ``map_server``: a YAML file that names a picture.

Cells come out as ``map_server`` of ROS 1 (navigation, Noetic) publishes them: a dark pixel
is occupied, a bright one free, and the modes ``trinary``, ``scale`` and ``raw`` define what
becomes of those between (wiki.ros.org/map_server).
"""

from __future__ import annotations

import math
import os
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Literal, get_args

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Bytes
from gazelle.description import Pose, Source
from gazelle.description.occupancy import FREE, OCCUPIED, UNKNOWN, OccupancyMap
from gazelle.errors import FormatError, ResolveError, did_you_mean
from gazelle.formats import blanks, xml
from gazelle.formats.picture import read_picture
from gazelle.formats.reading import Reading
from gazelle.formats.resolve import Resolver
from gazelle_ros.base import characters
from gazelle_ros.base.path_texts import existing_file

if TYPE_CHECKING:
    import yaml

PathLike = str | os.PathLike[str]
Mode = Literal["trinary", "scale", "raw"]

MAX_BYTES = 2**16

_COMMENT = re.compile("#[^\r\n]*")
_REQUIRED = ("image", "resolution", "origin", "negate", "occupied_thresh", "free_thresh")
_KEYS = (*_REQUIRED, "mode")
_MODES: tuple[Mode, ...] = get_args(Mode)
_FLAGS = {"0": False, "1": True, "false": False, "true": True}


@dataclass(frozen=True, slots=True)
class MapSettings:
    """Settings in the YAML file.

    Attributes:
        image: The picture, as written.
        resolution: Side of a pixel [m].
        origin: x, y [m] and yaw [rad] of the lower left corner of the picture.
        negate: Whether bright is occupied.
        occupied_thresh: Darkness, 0 to 1, above which a cell is occupied.
        free_thresh: Darkness below which a cell is free.
        mode: Treatment of pixels between the thresholds.
    """

    image: str
    resolution: float
    origin: tuple[float, float, float]
    negate: bool
    occupied_thresh: float
    free_thresh: float
    mode: Mode = "trinary"


def load_map(path: PathLike, *, paths: Sequence[PathLike] = ()) -> OccupancyMap:
    """Load a ``map_server`` YAML file; its picture may be PGM, PNG, BMP, JPG and others.

    Args:
        path: The YAML file.
        paths: Folders to search for the picture before all others.

    Raises:
        FormatError: The YAML or the picture cannot be read; it names file and line.
        ResolveError: There is no such YAML file or picture.
    """
    file = existing_file(path)
    reading = Reading(Resolver(paths, file=file))
    found = read_map(file, reading)
    reading.report(strict=False)
    return found


def read_map(file: Path, reading: Reading) -> OccupancyMap:
    """Read a ``map_server`` YAML file and its picture; unknown keys are noted.

    Raises:
        FormatError: The YAML or the picture cannot be read; it names file and line.
        ResolveError: There is no such picture.
    """
    nodes = _read_nodes(xml.read_bytes(file), str(file), reading)
    settings = _read_settings(nodes)
    _check_thresholds(settings, nodes, reading)
    picture = reading.resolver.find(settings.image, file.parent)
    if picture is None or not picture.is_file():
        looked = characters.curly_hint(settings.image) or reading.resolver.looked_in(
            settings.image, file.parent
        )
        raise nodes["image"].fail(
            f"the picture '{settings.image}' is not found", ResolveError, looked
        )
    try:
        pixels = read_picture(picture)
    except FormatError as error:
        text = f"'{settings.image}': {error.message}"
        raise nodes["image"].fail(text, hint=error.hint) from error
    x, y, yaw = settings.origin
    return OccupancyMap(
        data=cells(pixels, settings, blue_first=picture.suffix.lower() == ".bmp"),
        resolution=settings.resolution,
        origin=Pose(x, y, yaw=yaw),
        name=file.stem,
        source=Source(str(file), 1),
    )


def cells(pixels: Bytes, settings: MapSettings, *, blue_first: bool = False) -> NDArray[np.int8]:
    """Return the cells of a picture as in ``map_server``, shape (height, width), bottom first.

    In mode ``trinary`` transparency counts as a colour; in the others a cell between the
    thresholds is unknown where the last byte of its pixel is 0: that of transparency, but
    without one that of blue (red in a BMP). This is what ``map_server`` does.

    Args:
        pixels: Shape (height, width, channels), top row first.
        settings: Content of the YAML file.
        blue_first: Whether pixels stand as blue, green, red in the file.
    """
    count = pixels.shape[2]
    last = pixels[..., 0 if blue_first and count == 3 else -1]
    used = pixels[..., :3] if count == 4 and settings.mode != "trinary" else pixels
    total = used.sum(axis=2, dtype=np.uint16)
    average = np.arange(255 * used.shape[2] + 1) / used.shape[2]
    values = _values(255.0 - average if settings.negate else average, settings)
    data = values[total]
    if settings.mode == "scale" and count > 1:
        free, occupied = values == FREE, values == OCCUPIED
        data[(last == 0) & ~(free | occupied)[total]] = UNKNOWN
    return np.ascontiguousarray(data[::-1])


def _values(average: NDArray[np.float64], settings: MapSettings) -> NDArray[np.int8]:
    """Return the cell for each brightness, 0 to 255."""
    if settings.mode == "raw":
        return average.astype(np.uint8).view(np.int8)
    dark = (255.0 - average) / 255.0
    low, high = settings.free_thresh, settings.occupied_thresh
    values = np.full(average.shape, UNKNOWN, np.int8)
    if settings.mode == "scale" and high > low:
        between = (dark >= low) & (dark <= high)
        values[between] = (1.0 + 98.0 * ((dark[between] - low) / (high - low))).astype(np.int8)
    values[dark < low] = FREE
    values[dark > high] = OCCUPIED
    return values


@dataclass(frozen=True, slots=True)
class _Node:
    """A value of the YAML file with its place."""

    key: str
    value: yaml.Node
    source: Source

    def fail(
        self, message: str, kind: type[FormatError] = FormatError, hint: str | None = None
    ) -> FormatError:
        """Return the error to raise about it."""
        return kind(message, source=self.source, hint=hint)

    def text(self) -> str:
        """Return the scalar as text."""
        value = self.value.value
        if not isinstance(value, str):
            raise self.fail(f"expected one value in '{self.key}', found several")
        return value.strip()

    def number(self) -> float:
        """Return the scalar as a finite number."""
        return self._number(self.text())

    def numbers(self, count: int) -> tuple[float, ...]:
        """Return a list of a given number of finite numbers."""
        items = self.value.value
        if isinstance(items, str) or len(items) != count:
            raise self.fail(f"expected {count} numbers in '{self.key}', such as [0.0, 0.0, 0.0]")
        return tuple(self._number(str(getattr(item, "value", ""))) for item in items)

    def _number(self, text: str) -> float:
        try:
            number = float(text)
        except ValueError:
            number = math.nan
        if not math.isfinite(number):
            raise self.fail(f"expected a number in '{self.key}', found '{text[:80]}'")
        return number


def _read_nodes(data: bytes, name: str, reading: Reading) -> dict[str, _Node]:
    """Read the values of the YAML file by key; all that are required are there."""
    root = _parse(blanks.plain_bytes(data, name, _COMMENT, reading.misread), name)
    nodes: dict[str, _Node] = {}
    for key_node, value in root.value:
        key = str(key_node.value)
        node = _Node(key, value, Source(name, key_node.start_mark.line + 1, key))
        if key in nodes:
            raise node.fail(f"'{key}' is given twice")
        nodes[key] = node
    missing = [key for key in _REQUIRED if key not in nodes]
    unknown = [key for key in nodes if key not in _KEYS]
    if missing:
        hint = did_you_mean(missing[0], unknown) if unknown else None
        raise FormatError(f"a map needs the key '{missing[0]}'", file=name, line=1, hint=hint)
    for key in unknown:
        reading.remark(
            f"'{key}' is not a key of a map and was ignored",
            nodes[key].source,
            did_you_mean(key, _KEYS),
        )
    return nodes


def _parse(data: bytes, name: str) -> yaml.MappingNode:
    """Return the YAML file as nodes, which know their lines."""
    import yaml

    if len(data) > MAX_BYTES:
        raise FormatError(f"the file is larger than {MAX_BYTES} bytes", file=name)
    try:
        root = yaml.compose(data, Loader=yaml.SafeLoader)
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        problem = getattr(error, "problem", None) or "it cannot be decoded"
        line = None if mark is None else mark.line + 1
        raise FormatError(f"this is not valid YAML: {problem}", file=name, line=line) from None
    except (RecursionError, UnicodeError, ValueError):
        raise FormatError("this is not valid YAML", file=name) from None
    if not isinstance(root, yaml.MappingNode):
        raise FormatError("expected keys and values such as 'image: map.pgm'", file=name, line=1)
    return root


def _read_settings(nodes: dict[str, _Node]) -> MapSettings:
    x, y, yaw = nodes["origin"].numbers(3)
    image = nodes["image"].text()
    if not image:
        raise nodes["image"].fail("'image' must name a file")
    resolution = nodes["resolution"].number()
    if resolution <= 0.0:
        raise nodes["resolution"].fail(
            f"the resolution must be greater than zero, found {resolution:g}"
        )
    negate = nodes["negate"].text().lower()
    if negate not in _FLAGS:
        raise nodes["negate"].fail(f"expected 0 or 1 in 'negate', found '{negate[:80]}'")
    return MapSettings(
        image=image,
        resolution=resolution,
        origin=(x, y, yaw),
        negate=_FLAGS[negate],
        occupied_thresh=nodes["occupied_thresh"].number(),
        free_thresh=nodes["free_thresh"].number(),
        mode=_mode(nodes.get("mode")),
    )


def _check_thresholds(settings: MapSettings, nodes: dict[str, _Node], reading: Reading) -> None:
    low, high = settings.free_thresh, settings.occupied_thresh
    if low > high:
        reading.remark(
            f"free_thresh {low:g} is above occupied_thresh {high:g}: "
            "cells in between are occupied, and none is unknown",
            nodes["free_thresh"].source,
            "swap the two",
        )


def _mode(node: _Node | None) -> Mode:
    if node is None:
        return "trinary"
    text = node.text()
    for known in _MODES:
        if text == known:
            return known
    raise node.fail(f"unknown mode '{text[:80]}'", hint=did_you_mean(text, _MODES))
