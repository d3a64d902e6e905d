"""Colours of images that have one colour a pixel (Bayer's mosaics)."""

from __future__ import annotations

import numpy as np

from gazelle_ros.base.array_types import Pixels


def demosaic(image: Pixels, order: str) -> Pixels:
    """Return red, green and blue, each missing one the mean of its nearest pixels, as OpenCV does.

    Args:
        image: Of 8 or 16 bits, shape (height, width), both at least 3.
        order: Colours of the first two pixels of the first row, then of the second: ``rggb``.
    """
    wide = image.astype(np.uint32)
    middle = wide[1:-1, 1:-1]
    across = (wide[1:-1, :-2] + wide[1:-1, 2:] + 1) >> 1
    down = (wide[:-2, 1:-1] + wide[2:, 1:-1] + 1) >> 1
    beside = (wide[1:-1, :-2] + wide[1:-1, 2:] + wide[:-2, 1:-1] + wide[2:, 1:-1] + 2) >> 2
    corners = (wide[:-2, :-2] + wide[:-2, 2:] + wide[2:, :-2] + wide[2:, 2:] + 2) >> 2
    found = np.empty((*image.shape, 3), image.dtype)
    inner = found[1:-1, 1:-1]
    for row in range(2):
        for column in range(2):
            own = order[2 * row + column]
            if own == "g":
                planes = {
                    "g": middle,
                    order[2 * row + 1 - column]: across,
                    order[2 * (1 - row) + column]: down,
                }
            else:
                planes = {own: middle, "g": beside, "b" if own == "r" else "r": corners}
            # The inner part begins at the second row and column.
            some = slice(1 - row, None, 2), slice(1 - column, None, 2)
            for place, colour in enumerate("rgb"):
                inner[(*some, place)] = planes[colour][some]
    found[:, 0], found[:, -1] = found[:, 1], found[:, -2]
    found[0], found[-1] = found[1], found[-2]
    return found


def grey(colours: Pixels) -> Pixels:
    """Return the luminance of red, green and blue, shape (height, width, 3), as OpenCV weighs them."""
    if colours.dtype.kind == "f":
        weights = np.array([0.299, 0.587, 0.114], colours.dtype)
        exact: Pixels = np.einsum("ijk,k->ij", colours, weights)
        return exact
    weighed = np.einsum(
        "ijk,k->ij", colours.astype(np.uint32), np.array([9798, 19235, 3735], np.uint32)
    )
    rounded: Pixels = ((weighed + (1 << 14)) >> 15).astype(colours.dtype)
    return rounded
