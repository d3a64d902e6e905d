"""Pixels of a picture in SDF's ``<format>``, and its name in ROS."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Bytes, Floats
from gazelle.errors import SimulationWarning

# Of each mosaic the colours of two rows of two pixels; names as in image_encodings.h.
_MOSAICS = {
    "BAYER_RGGB8": ("bayer_rggb8", (0, 1, 1, 2)),
    "BAYER_BGGR8": ("bayer_bggr8", (2, 1, 1, 0)),
    "BAYER_GBRG8": ("bayer_gbrg8", (1, 2, 0, 1)),
    "BAYER_GRBG8": ("bayer_grbg8", (1, 0, 2, 1)),
}
_ENCODINGS = {
    "L8": "mono8",
    "L_INT8": "mono8",
    "L16": "mono16",
    "L_INT16": "mono16",
    "L_UINT16": "mono16",
    "R8G8B8": "rgb8",
    "RGB_INT8": "rgb8",
    "B8G8R8": "bgr8",
    "BGR_INT8": "bgr8",
    "R16G16B16": "rgb16",
    "RGB_INT16": "rgb16",
    "RGB_UINT16": "rgb16",
}
_GREY = np.array([0.299, 0.587, 0.114])  # ITU-R BT.601


def encoding_of(format_: str, name: str) -> str:
    """Return ROS's name of a format; bgr8, with a warning, for one that is not known.

    Args:
        format_: As the file has it.
        name: Of the sensor, for the warning.
    """
    known = _ENCODINGS.get(format_) or _MOSAICS.get(format_, ("",))[0]
    if not known:
        warnings.warn(
            SimulationWarning(
                f"camera '{name}' has the format '{format_}', which is none of "
                f"{', '.join([*_ENCODINGS, *_MOSAICS])}; its pictures are bgr8, as in Gazebo"
            ),
            stacklevel=2,
        )
    return known or "bgr8"


def pixels_of(color: Bytes, encoding: str) -> NDArray[Any]:
    """Return pixels in an encoding.

    Args:
        color: Red, green, blue, shape (n, height, width, 3).
        encoding: One that ``encoding_of`` gives.
    """
    if encoding == "rgb8":
        return color
    if encoding == "bgr8":
        return np.ascontiguousarray(color[..., ::-1])
    if encoding == "rgb16":
        return color.astype(np.uint16) * np.uint16(257)
    if encoding in ("mono8", "mono16"):
        grey: Floats = np.rint(color @ _GREY)
        return grey.astype(np.uint8) if encoding == "mono8" else (grey * 257).astype(np.uint16)
    cells = next(cells for name, cells in _MOSAICS.values() if name == encoding)
    mosaic = np.empty(color.shape[:-1], np.uint8)
    for place, channel in enumerate(cells):
        rows, columns = slice(place // 2, None, 2), slice(place % 2, None, 2)
        mosaic[:, rows, columns] = color[:, rows, columns, channel]
    return mosaic
