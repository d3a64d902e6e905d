"""Rounding of whole arrays exactly as Python's ``round`` does it."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

_SPLIT = 2.0**27 + 1.0
_SCALE = 100.0


def round2(values: ArrayLike) -> NDArray[np.float64]:
    """Round to two decimals, bit for bit as ``round(value, 2)`` would.

    ``numpy.round`` multiplies by 100 first, and that product can land on a tie which the
    number itself is not on. Here the error of the product (T. J. Dekker, "A floating-point
    technique for extending the available precision", 1971) settles such ties.

    Args:
        values: Finite numbers below 1e15, any shape.

    Returns:
        Rounded numbers, same shape.
    """
    x = np.asarray(values, dtype=np.float64)
    product = x * _SCALE
    whole = np.rint(product)
    tied = np.abs(product - whole) == 0.5  # exact: both are multiples of 0.5 there
    if tied.any():
        whole[tied] = _settled(x[tied], product[tied])
    rounded: NDArray[np.float64] = whole / _SCALE
    return rounded


def _settled(x: NDArray[np.float64], product: NDArray[np.float64]) -> NDArray[np.float64]:
    """Which ints numbers are nearest to whose product seems to be in the middle."""
    high = x * _SPLIT
    high -= high - x
    error = (high * _SCALE - product) + (x - high) * _SCALE
    below = np.floor(product)
    settled = np.where(error > 0.0, below + 1.0, below)
    return np.where(error != 0.0, settled, np.rint(product))
