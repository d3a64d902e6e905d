"""Pictures as ground: heights of a heightmap, boxes of an image."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Bytes, Floats
from gazelle.description import Heightmap, Image, Source
from gazelle.errors import FormatError
from gazelle.formats.elevations import READERS
from gazelle.formats.picture import read_picture

T = TypeVar("T")

_LEAST = 1e-6
"""Elevation that counts as none."""


def load_heights(shape: Heightmap) -> Floats:
    """Load heights over the grid of a heightmap [m], shape (rows, columns).

    They are relative to its position.

    Row 0 is at the least y, column 0 at the least x; the corners of the grid are those of
    ``size``. As in Gazebo Classic the brightest pixel has the height ``size[2]`` and black
    none; where that is negative, heights h become 1 - h. A TIFF, an SRTM tile (``.hgt``), an
    ESRI grid (``.asc``) and a model of the USGS (``.dem``) hold elevations: as in Gazebo built with GDAL the highest is scaled to ``size[2]`` and 0 stays the sea, below which nothing
    lies; the lowest is put to height 0.

    Raises:
        FormatError: The picture was not found or cannot be read; it names the place in the
            description.
    """
    read = None if shape.path is None else READERS.get(shape.path.suffix.lower())
    if read is not None:
        heights = _above_ground(_named(shape, read), shape.size[2])
    else:
        grey = _grey(_named(shape, read_picture))
        brightest = float(grey.max())
        heights = grey * (abs(shape.size[2]) / brightest if brightest > 0.0 else 0.0)
        heights = 1.0 - heights if shape.size[2] < 0.0 else heights
    if min(heights.shape) < 2:
        raise FormatError(
            f"the heightmap '{shape.path}' has {heights.shape[1]} x {heights.shape[0]} pixels",
            source=shape.source,
            hint="ground needs two heights along each side at least",
        )
    return np.ascontiguousarray(heights[::-1])


def _above_ground(elevations: Floats, height: float) -> Floats:
    """Return heights of elevations; the lowest is at 0, unless that is below the sea [m].

    What is lower, and what is not known (a large negative number, by custom), is at 0; so it is
    where ``height`` is negative and all is turned over, but for what is lower.
    """
    finite = np.isfinite(elevations)
    lowest = float(elevations[finite].min()) if finite.any() else 0.0
    known = np.where(finite, elevations, min(lowest, 0.0))
    highest = float(known.max())
    scale = abs(height) / highest if abs(highest) > _LEAST else abs(height)
    above = (known - max(0.0, float(known.min()))) * scale
    return np.maximum(above, 0.0) if height >= 0.0 else -above


def load_boxes(shape: Image) -> Floats:
    """Load centres and sizes along x, y [m] of the boxes of an image, shape (n, 4).

    The picture is centred at the origin, its top row at the greatest y; a pixel not
    brighter than the threshold is part of a box.

    Raises:
        FormatError: As ``load_heights``.
    """
    dark = _grey(_named(shape, read_picture)) <= shape.threshold
    step = max(1, shape.granularity)
    height, width = dark.shape
    padded = np.zeros((-(-height // step) * step, -(-width // step) * step), bool)
    padded[:height, :width] = dark
    tiles = padded.reshape(padded.shape[0] // step, step, -1, step)
    blocks = np.logical_or.reduce(tiles, axis=(1, 3))
    left, top, right, bottom = (rectangles(blocks) * float(step)).T
    centres = ((left + right - width) / 2.0, (height - top - bottom) / 2.0)
    return np.stack([*centres, right - left, bottom - top], axis=1) * shape.scale


def rectangles(cells: NDArray[np.bool_]) -> NDArray[np.int64]:
    """Return rectangles that cover the true cells once: left, top, right, bottom, shape (n, 4).

    Runs of each row, joined with those of the same columns in the rows below.
    """
    framed = np.pad(cells, ((0, 0), (1, 1))).astype(np.int8)
    change = np.diff(framed, axis=1)
    rows, starts = np.nonzero(change == 1)
    ends = np.nonzero(change == -1)[1]
    found: list[tuple[int, int, int, int]] = []
    growing: dict[tuple[int, int], tuple[int, int]] = {}
    for row, start, end in zip(rows.tolist(), starts.tolist(), ends.tolist(), strict=True):
        top, last = growing.get((start, end), (row, row))
        if last < row - 1:
            found.append((start, top, end, last + 1))
            top = row
        growing[start, end] = (top, row)
    found += [(start, top, end, last + 1) for (start, end), (top, last) in growing.items()]
    return np.array(sorted(found), np.int64).reshape(-1, 4)


def _grey(pixels: Bytes) -> Floats:
    grey: Floats = pixels[..., :3].astype(np.float64).mean(axis=2)
    return grey


def _named(shape: Heightmap | Image, read: Callable[[Path], T]) -> T:
    """Read the picture of a shape; errors name the place in the description."""
    kind = type(shape).__name__.lower()
    if shape.path is None:
        raise FormatError(f"the picture '{shape.uri}' was not found", source=shape.source)
    try:
        return read(shape.path)
    except FormatError as error:
        raise FormatError(
            f"the {kind} '{shape.path}' cannot be used: {error.message}",
            source=shape.source or Source(str(shape.path)),
            hint=error.hint,
        ) from error
