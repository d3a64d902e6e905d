"""Numbers that people give: in files, as parameters and as arguments."""

from __future__ import annotations

import math
from numbers import Real
from typing import Any


def real(value: Any) -> float | None:
    """Return a number as a float, NaN and infinity included.

    None for what is not a number: a bool, a text, or an int beyond all floats.
    """
    if isinstance(value, bool) or not isinstance(value, Real):
        return None
    try:
        return float(value)
    except OverflowError:
        return None


def finite(value: Any, most: float = math.inf) -> float | None:
    """Return a finite number as a float; None for anything else, and beyond ``most``."""
    number = real(value)
    return number if number is not None and math.isfinite(number) and abs(number) <= most else None
