"""Image encodings by name (sensor_msgs/image_encodings.h)."""

from __future__ import annotations

import re
from dataclasses import dataclass

import numpy as np

DEPTHS = {"8U": "u1", "8S": "i1", "16U": "u2", "16S": "i2", "32S": "i4", "32F": "f4", "64F": "f8"}
"""numpy's types of OpenCV's depths, in the order of OpenCV's numbers."""
_PLAIN = re.compile(r"(8U|8S|16U|16S|32S|32F|64F)C([0-9]+)")
_NAMED = {
    "mono8": ("u1", "Y"),
    "mono16": ("u2", "Y"),
    **{f"{order}{bits}": (kind, order)
       for order in ("rgb", "bgr", "rgba", "bgra")
       for bits, kind in ((8, "u1"), (16, "u2"))},
}  # fmt: skip
_MOSAICS = tuple(
    f"bayer_{order}{bits}" for order in ("rggb", "bggr", "gbrg", "grbg") for bits in (8, 16)
)


class CvBridgeError(TypeError):
    """An image cannot be converted."""


@dataclass(frozen=True, slots=True)
class Encoding:
    """Encoding of an image's pixels."""

    name: str
    kind: str
    """numpy's type of one value, without the byte order."""
    channels: int
    order: str = ""
    """The meaning of the channels, such as ``bgra``; empty if they have none."""


def encoding_of(name: str) -> Encoding:
    """Return the encoding of a name.

    Raises:
        CvBridgeError: It is unknown.
    """
    known = name.lower()
    if known in _NAMED:
        kind, order = _NAMED[known]
        return Encoding(known, kind, len(order), order)
    if known in _MOSAICS:
        return Encoding(known, "u2" if known.endswith("16") else "u1", 1)
    if known in {"yuv422", "yuv422_yuy2"}:
        return Encoding(known, "u1", 2)
    plain = _PLAIN.fullmatch(name.upper())
    if plain:
        return Encoding(name.upper(), DEPTHS[plain[1]], int(plain[2]))
    if name.upper() in DEPTHS:
        return Encoding(name.upper() + "C1", DEPTHS[name.upper()], 1)
    raise CvBridgeError(f"unrecognized image encoding [{name}]")


def encoding_for(kind: np.dtype[np.generic], channels: int) -> str:
    """Return the name of the plain encoding of arrays, such as ``8UC3``.

    Raises:
        CvBridgeError: OpenCV has no such type.
    """
    for depth, name in DEPTHS.items():
        if np.dtype(name) == kind.newbyteorder("="):
            return f"{depth}C{channels}"
    raise CvBridgeError(f"images of the type {kind} have no encoding")


def getCvType(encoding: str) -> int:  # noqa: N802  # cv_bridge's name
    """Return OpenCV's number of an encoding's type."""
    found = encoding_of(encoding)
    depth = [*DEPTHS.values()].index(found.kind)
    return depth + ((found.channels - 1) << 3)
