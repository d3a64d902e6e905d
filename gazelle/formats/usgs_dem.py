"""Digital elevation models of the U.S. Geological Survey: ASCII in records of 1024 bytes.

Record A is the head of the file, records B are profiles from south to north, which stand beside
each other from west to east and may begin at different places ("Standards for Digital Elevation
Models, Part 2: Specifications", U.S. Geological Survey, 1992).
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np

from gazelle.array_types import Floats
from gazelle.errors import FormatError
from gazelle.formats.lfs import refuse_pointer
from gazelle.formats.limits import read_bounded

_RECORD: Final = 1024
_SPACING: Final = slice(816, 852)
"""In record A: resolution along x, y and up, of 12 characters each."""
_PROFILES: Final = slice(858, 864)
"""In record A: how many profiles there are."""
_HEAD: Final = 144
_WIDTH: Final = 6
_FIRST, _MORE = 146, 170  # elevations in the first record of a profile, and in each further one
_UNKNOWN: Final = -32766
_LARGEST: Final = 20_000
"""More points along a side than this are taken for damage; a sheet has some 1,400."""


@dataclass(frozen=True, slots=True)
class _Profile:
    """One column of the model: where it begins [ground units], and what stands on it."""

    x: float
    y: float
    elevations: Floats


def read_usgs_dem(path: Path) -> Floats:
    """Read the elevations of a model, shape (rows, columns), the north first; NaN if unknown.

    Raises:
        FormatError: It cannot be read, or is no such file.
    """
    try:
        data = read_bounded(path)
        refuse_pointer(data, path)
        records = _records(data)
        dx, dy, unit = _resolution(records[0][_SPACING])
        profiles = _profiles(records, int(records[0][_PROFILES]), unit)
        return _grid(profiles, dx, dy)
    except OSError as error:
        raise FormatError(f"cannot read: {error.strerror}", file=str(path)) from error
    except (ValueError, IndexError) as error:
        raise FormatError(
            f"this is not an elevation model of the USGS, or it is damaged: {error}",
            file=str(path),
            hint="make a picture or a TIFF of it: gdal_translate FILE.dem FILE.tif",
        ) from None


def _records(data: bytes) -> list[str]:
    """Return the records, which some programs separate by line ends."""
    text = data.decode("latin-1")
    lines = text.splitlines()
    if len(lines) > 1:
        return [line.ljust(_RECORD) for line in lines]
    return [text[i : i + _RECORD] for i in range(0, len(text), _RECORD)]


def _resolution(text: str) -> tuple[float, float, float]:
    """Return the spacing of its points along x and y, and the unit of their heights."""
    dx, dy, unit = (_real(text[i : i + 12]) for i in (0, 12, 24))
    if not (dx > 0.0 and dy > 0.0):
        raise ValueError(f"its points are {dx:g} x {dy:g} apart")
    return dx, dy, unit


def _profiles(records: list[str], count: int, unit: float) -> list[_Profile]:
    found, at = [], 1
    for _ in range(count):
        head = records[at][:_HEAD]
        rows = int(head[12:18])
        if not 0 < rows <= _LARGEST:
            raise ValueError(f"a profile has {rows} points")
        further = -(-max(0, rows - _FIRST) // _MORE)
        blocks = [records[at][_HEAD : _HEAD + _FIRST * _WIDTH]]
        blocks += [each[: _MORE * _WIDTH] for each in records[at + 1 : at + 1 + further]]
        text = "".join(blocks)
        values = [int(text[i : i + _WIDTH]) for i in range(0, rows * _WIDTH, _WIDTH)]
        raw = np.array(values, np.float64)
        x, y, datum = (_real(head[i : i + 24]) for i in (24, 48, 72))
        known = np.where(raw > _UNKNOWN, datum + raw * unit, np.nan)
        found.append(_Profile(x, y, known))
        at += 1 + further
    if not found:
        raise ValueError("it has no profiles")
    return found


def _grid(profiles: list[_Profile], dx: float, dy: float) -> Floats:
    """Return the profiles side by side, at their places."""
    west, south = min(p.x for p in profiles), min(p.y for p in profiles)
    columns = [round((p.x - west) / dx) for p in profiles]
    rows = [round((p.y - south) / dy) for p in profiles]
    height = max(row + len(p.elevations) for row, p in zip(rows, profiles, strict=True))
    width = max(columns) + 1
    if max(height, width) > _LARGEST:
        raise ValueError(f"its profiles span {width} x {height} points")
    grid = np.full((height, width), np.nan)
    for row, column, profile in zip(rows, columns, profiles, strict=True):
        grid[row : row + len(profile.elevations), column] = profile.elevations
    return grid[::-1]


def _real(text: str) -> float:
    """Return a number as Fortran writes it, ``0.3D+02``; NaN and infinities are rejected.

    Raises:
        ValueError: It is not a number.
    """
    value = float(text.upper().replace("D", "E"))
    if not np.isfinite(value):
        raise ValueError(f"'{text.strip()}' is not a number")
    return value
