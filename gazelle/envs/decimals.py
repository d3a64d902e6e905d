# cython: infer_types=True, annotation_typing=False
# mypy: disable-error-code="misc, no-any-return"
"""Rounding of whole arrays exactly as Python's ``round`` does it."""

from __future__ import annotations

import cython
import numpy as np
from cython.cimports.libc.math import floor, rint
from numpy.typing import ArrayLike

from gazelle.array_types import Floats

SPLIT = cython.declare(cython.double, 2.0**27 + 1.0)
SCALE = cython.declare(cython.double, 100.0)


def round2(values: ArrayLike) -> Floats:
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
    rounded = np.empty(x.size)
    round_all(np.ascontiguousarray(x.reshape(-1)), rounded)
    return rounded.reshape(x.shape)


def round_all(x: Floats, rounded: Floats) -> None:
    """Round numbers, shape (n,)."""
    ties = 0
    for i in range(x.shape[0]):
        product = x[i] * SCALE
        whole = rint(product)
        ties += abs(product - whole) == 0.5  # exact: both are multiples of 0.5 there
        rounded[i] = whole / SCALE
    if ties:
        for i in range(x.shape[0]):
            product = x[i] * SCALE
            if abs(product - rint(product)) == 0.5:
                rounded[i] = settled(x[i], product) / SCALE


def settled(x: float, product: float) -> float:
    """Which int a number is nearest to whose product seems to be in the middle."""
    high = x * SPLIT
    high -= high - x
    error = (high * SCALE - product) + (x - high) * SCALE
    if error == 0.0:
        return rint(product)
    below = floor(product)
    return below + 1.0 if error > 0.0 else below
