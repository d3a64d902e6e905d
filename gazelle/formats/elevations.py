"""Files of elevations: which there are, and those that are no pictures.

A TIFF is a picture. SRTM's ``.hgt`` is whole metres of 16 bits, the most significant byte first,
rows from north to south, -32768 where nothing is known (SRTM Topography, U.S. Geological Survey).
An ESRI ASCII grid, ``.asc``, has a head of names and values and the rows of the grid from north
to south (ArcGIS, "Esri ASCII raster format"). The USGS's ``.dem`` has a module of its own.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Final

import numpy as np

from gazelle.array_types import Floats
from gazelle.errors import FormatError
from gazelle.formats.lfs import refuse_pointer
from gazelle.formats.limits import read_bounded
from gazelle.formats.picture import MAX_PIXELS, read_elevations
from gazelle.formats.usgs_dem import read_usgs_dem

_UNKNOWN = -32768
_OBLONG = (3601, 1801)  # north of 50 degrees a degree has half as many columns
_REQUIRED = ("ncols", "nrows")
_OTHERS = (
    "xllcorner",
    "yllcorner",
    "xllcenter",
    "yllcenter",
    "cellsize",
    "dx",
    "dy",
    "nodata_value",
)
_MISSING = "-9999"  # optional in the header of a grid


def read_srtm(path: Path) -> Floats:
    """Read the elevations of an SRTM tile [m], shape (rows, columns), the north first.

    NaN if unknown.

    Raises:
        FormatError: It cannot be read, or is no such file.
    """
    data = _bytes_of(path)
    side = math.isqrt(len(data) // 2)
    shape = _OBLONG if len(data) == 2 * math.prod(_OBLONG) else (side, side)
    if len(data) != 2 * math.prod(shape) or not side:
        raise FormatError(
            f"{len(data)} bytes are not a tile of elevations: expected two for each point of a square",
            file=str(path),
            hint="SRTM's tiles have 1201 x 1201 or 3601 x 3601 points",
        )
    metres = np.frombuffer(data, ">i2").reshape(shape).astype(np.float64)
    return np.where(metres == _UNKNOWN, np.nan, metres)


def read_ascii_grid(path: Path) -> Floats:
    """Read the values of an ESRI ASCII grid, shape (rows, columns), the north first.

    NaN if unknown.

    Raises:
        FormatError: It cannot be read, or is no such file.
    """
    words = _bytes_of(path).decode("latin-1").split()
    head, first = _head_of(words)
    columns, rows = (_count(head, name, path) for name in ("ncols", "nrows"))
    if len(words) - first != rows * columns:
        raise FormatError(
            f"the grid has {len(words) - first} values, expected {rows} x {columns}", file=str(path)
        )
    try:
        values = np.array(words[first:], np.float64)
        missing = float(head.get("nodata_value", _MISSING))
    except ValueError as error:
        raise FormatError(f"a value of the grid is not a number: {error}", file=str(path)) from None
    return np.where(values == missing, np.nan, values).reshape(rows, columns)


READERS: Final[dict[str, Callable[[Path], Floats]]] = {
    ".asc": read_ascii_grid,
    ".dem": read_usgs_dem,
    ".hgt": read_srtm,
    ".tif": read_elevations,
    ".tiff": read_elevations,
}
"""Readers of elevation files, by suffix."""


def _bytes_of(path: Path) -> bytes:
    try:
        data = read_bounded(path)
    except OSError as error:
        raise FormatError(f"cannot read: {error.strerror}", file=str(path)) from error
    refuse_pointer(data, path)
    return data


def _head_of(words: list[str]) -> tuple[dict[str, str], int]:
    """Read values by names at the head of a grid, and the start of its numbers."""
    head: dict[str, str] = {}
    first = 0
    while first + 1 < len(words) and words[first].lower() in (*_REQUIRED, *_OTHERS):
        head[words[first].lower()] = words[first + 1]
        first += 2
    return head, first


def _count(head: dict[str, str], name: str, path: Path) -> int:
    """Return the number of rows or columns in a grid's head."""
    text = head.get(name, "")
    count = int(text) if text.isdecimal() else 0
    if not 0 < count <= MAX_PIXELS:
        raise FormatError(
            f"expected a number of '{name}' at the head of the grid, found '{text}'",
            file=str(path),
            hint="an ESRI ASCII grid begins with ncols, nrows, xllcorner, yllcorner and cellsize",
        )
    return count
