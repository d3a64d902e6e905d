"""C's functions of numbers, for Python that runs the sources of compiled modules.

Python's own raise errors where C's give infinity or NaN, and give ints where C's give doubles.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from math import copysign, cos, fabs, frexp, isfinite, isinf, isnan, sin, tan
from typing import Final

import numpy as np

__all__ = [
    "INFINITY", "M_PI", "NAN", "atan", "atan2", "ceil", "copysign", "cos", "exp", "fabs", "floor",
    "fmax", "fmin", "fmod", "frexp", "hypot", "isfinite", "isinf", "isnan", "log", "pow", "rint",
    "sin", "sqrt", "tan", "trunc",
]  # fmt: skip

INFINITY: Final = math.inf
NAN: Final = math.nan
M_PI: Final = math.pi


def _lawless(function: Callable[..., float]) -> Callable[..., float]:
    def lawless(*values: float) -> float:
        with np.errstate(all="ignore"):
            return float(function(*map(float, values)))

    return lawless


def _or_numpy(function: Callable[..., float], other: Callable[..., float]) -> Callable[..., float]:
    """Return Python's function, which is the C library's, where it has a value."""
    spare = _lawless(other)

    def lawless(*values: float) -> float:
        try:
            return function(*values)
        except (ValueError, OverflowError):
            return spare(*values)

    return lawless


floor, ceil, trunc = _lawless(np.floor), _lawless(np.ceil), _lawless(np.trunc)
rint, fmin, fmax = _lawless(np.rint), _lawless(np.fmin), _lawless(np.fmax)
sqrt, log, exp = (
    _or_numpy(math.sqrt, np.sqrt),
    _or_numpy(math.log, np.log),
    _or_numpy(math.exp, np.exp),
)
pow = _or_numpy(math.pow, np.power)  # noqa: A001  # C's name
fmod, hypot = _or_numpy(math.fmod, np.fmod), _lawless(np.hypot)
atan, atan2 = math.atan, math.atan2
