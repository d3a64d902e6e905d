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


def round2(values: ArrayLike) -> Floats:
    """Round to two decimals, see `rounded`."""
    return rounded(values, 2)


def rounded(values: ArrayLike, decimals: int) -> Floats:
    """Round to some decimals, bit for bit as ``round(value, decimals)`` would.

    ``numpy.round`` multiplies by 10, 100, ... first, and that product can land on a tie which the
    number itself is not on. Here the error of the product (T. J. Dekker, "A floating-point
    technique for extending the available precision", 1971) settles such ties.

    Args:
        values: Finite numbers below 1e15, any shape.
        decimals: 0 to 3.

    Returns:
        Rounded numbers, same shape.
    """
    x = np.asarray(values, dtype=np.float64)
    found = np.empty(x.size)
    round_all(np.ascontiguousarray(x.reshape(-1)), found, 10.0**decimals)
    return found.reshape(x.shape)


def round_all(x: Floats, found: Floats, scale: float) -> None:
    """Round numbers, shape (n,), to multiples of one over the scale."""
    ties = 0
    for i in range(x.shape[0]):
        product = x[i] * scale
        whole = rint(product)
        ties += abs(product - whole) == 0.5  # exact: both are multiples of 0.5 there
        found[i] = whole / scale
    if ties:
        for i in range(x.shape[0]):
            product = x[i] * scale
            if abs(product - rint(product)) == 0.5:
                found[i] = settled(x[i], product, scale) / scale


def round_one(x: float, scale: float) -> float:
    """Return a number rounded to a multiple of one over the scale."""
    product = x * scale
    whole = rint(product)
    return (settled(x, product, scale) if abs(product - whole) == 0.5 else whole) / scale


def settled(x: float, product: float, scale: float) -> float:
    """Return the nearest int of a number with a product that seems half-way between two."""
    high = x * SPLIT
    high -= high - x
    error = (high * scale - product) + (x - high) * scale
    if error == 0.0:
        return rint(product)
    below = floor(product)
    return below + 1.0 if error > 0.0 else below
