"""Errors of building a world by code."""

from __future__ import annotations

import math

from gazelle.builders.limits import SMALLEST
from gazelle.errors import Error


class BuildError(Error):
    """A world or robot cannot be built as requested."""


def positive(value: float, what: str) -> float:
    """Return the value, if it is a finite number above zero.

    Raises:
        BuildError: It is not.
    """
    if not SMALLEST <= value < math.inf:
        raise BuildError(f"{what} must be a finite number above zero, found {value:g}")
    return float(value)


def finite(values: tuple[float, ...], what: str) -> None:
    """Check that all values are finite.

    Raises:
        BuildError: One is not.
    """
    if not all(map(math.isfinite, values)):
        shown = ", ".join(f"{value:g}" for value in values)
        raise BuildError(f"{what} must be finite, found {shown}")
