"""Limits of pictures, films and plots, which arguments and files make large."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from gazelle.array_types import Picture
from gazelle.errors import Error
from gazelle.sensors.limits import MAX_PIXELS

MAX_PICTURES = 10_000_000
"""Of a film: more than four days at 25 a second."""

MIN_RATE, MAX_RATE = 0.01, 1000.0
"""Pictures a second: a GIF shows none for longer than 655 s."""

MAX_GIF_PIXELS = 1 << 31
"""Of all pictures of a GIF together, which are in memory until it is written, a byte each."""

MOST_PANELS = 50
"""Of a plot, one for each column."""

_LONGEST = {".webp": 16383, ".jpg": 65500, ".jpeg": 65500, ".gif": 65535, ".mp4": 16384}
"""Longest side of a picture in a format [pixel]."""


def check_size(size: tuple[int, int], finer: int = 1) -> None:
    """Check that a picture of a size can be drawn.

    Args:
        size: Width and height [pixel].
        finer: Factor of its size along each side while drawing.

    Raises:
        Error: It is empty, or has too many pixels.
    """
    width, height = size
    most = MAX_PIXELS // finer**2
    if min(size) < 1 or width * height > most:
        raise Error(f"a picture has between 1 and {most} pixels, not {width} x {height}")


def check_rate(rate: float) -> None:
    """Check that a film can have a given number of pictures a second.

    Raises:
        Error: They are too few, or too many.
    """
    if not MIN_RATE <= rate <= MAX_RATE:
        raise Error(
            f"a film has between {MIN_RATE:g} and {MAX_RATE:g} pictures a second, not {rate:g}"
        )


def picture_count(seconds: float, period: float) -> int:
    """Return the number of pictures after the first in a film, at least one.

    Args:
        seconds: Simulated time.
        period: From one picture to the next [s].

    Raises:
        Error: They are too many.
    """
    if not seconds <= MAX_PICTURES * period:
        raise Error(
            f"a film of {seconds:g} s with a picture each {period:g} s has more than the limit of "
            f"{MAX_PICTURES:,} pictures",
            hint="take a higher speed, or a lower rate",
        )
    return max(1, round(seconds / period))


def check_picture(picture: Picture, file: Path) -> None:
    """Check that a file can hold a picture.

    Raises:
        Error: It is not a picture of bytes, or one of its sides is too long for the format.
    """
    shape = np.shape(picture)
    if len(shape) != 3 or shape[2] != 3 or 0 in shape or picture.dtype != np.uint8:
        raise Error(
            "a picture is an array of bytes of shape (height, width, 3), not of "
            f"{getattr(picture, 'dtype', type(picture).__name__)} of shape {shape}"
        )
    most = _LONGEST.get(file.suffix.lower())
    if most is not None and max(shape) > most:
        raise Error(
            f"'{file.name}' cannot hold a picture of {shape[1]} x {shape[0]} pixels: sides of a "
            f"{file.suffix} file have at most {most}"
        )
