"""Occupancy maps to the files of ROS's ``map_server``, as ``map_saver`` writes them."""

from __future__ import annotations

import math
import os
from pathlib import Path

import numpy as np
import yaml

from gazelle.argument_checks import checked
from gazelle.array_types import Bytes
from gazelle.description.occupancy import OccupancyMap
from gazelle.errors import FormatError
from gazelle_ros.base.writing import replacing, write_bytes

PathLike = str | os.PathLike[str]

_OCCUPIED, _FREE, _UNKNOWN = 0, 254, 205
"""Grey levels of cells."""
_DARK, _BRIGHT = 0.65, 0.196
"""Limits for reading: they separate the three levels, whatever the limits of the cells were."""


def grey_levels(grid: OccupancyMap, *, occupied: float = 65.0, free: float = 25.0) -> Bytes:
    """Return the picture of a map, top row first, shape (height, width): black, white and grey.

    Args:
        grid: The map.
        occupied: Cells from this value on are black.
        free: Cells from 0 up to this value are white; others are grey.

    Raises:
        FormatError: The limits are not in order, or the cells are no rows of numbers.
    """
    if np.ndim(grid.data) != 2:
        raise FormatError(
            f"the cells of a map must be rows, shape (height, width), not {np.shape(grid.data)}"
        )
    if not 0.0 <= free < occupied <= 100.0:
        raise FormatError("the limit of what is free is below that of what is occupied, 0 to 100")
    cells = np.asarray(grid.data)[::-1]
    levels = np.full(cells.shape, _UNKNOWN, np.uint8)
    levels[(cells >= 0) & (cells <= free)] = _FREE
    levels[cells >= occupied] = _OCCUPIED
    return levels


@checked(FormatError)
def save_map(
    grid: OccupancyMap, name: PathLike, *, occupied: float = 65.0, free: float = 25.0
) -> tuple[Path, Path]:
    """Write ``NAME.yaml`` and ``NAME.pgm``; returns both paths.

    Args:
        grid: The map.
        name: Path without suffix; a suffix ``.yaml`` is dropped.
        occupied: Cells from this value on are black.
        free: Cells up to this value are white; others are grey.

    Raises:
        FormatError: As of ``grey_levels``; the name is of a folder or of no file; or a file cannot
            be written.
    """
    stem = os.fspath(name).removesuffix(".yaml")
    if stem.rpartition("/")[2] in ("", ".", ".."):
        raise FormatError("this is a folder, not the name of a map", file=stem)
    levels = grey_levels(grid, occupied=occupied, free=free)
    picture, settings = Path(f"{stem}.pgm"), Path(f"{stem}.yaml")
    comment = f"# CREATOR: map_saver {grid.resolution:.3f} m/pix"
    head = f"P5\n{comment}\n{grid.width} {grid.height}\n255\n"
    origin = grid.origin
    text = (
        yaml.safe_dump({"image": picture.name}, allow_unicode=True, width=math.inf)
        + f"resolution: {grid.resolution:f}\n"
        f"origin: [{origin.x:f}, {origin.y:f}, {origin.yaw:f}]\nnegate: 0\n"
        f"occupied_thresh: {_DARK}\nfree_thresh: {_BRIGHT}\n"
    )
    try:
        with replacing(settings) as draft:
            draft.write_text(text, encoding="utf-8")
            write_bytes(picture, head.encode() + levels.tobytes())
    except OSError as error:
        raise FormatError(f"the map cannot be written: {error.strerror}", file=stem) from None
    return settings, picture
