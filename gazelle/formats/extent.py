"""Lengths of shapes that are not greater than zero, as Gazebo takes them."""

from __future__ import annotations

import math

from gazelle.description import Parameters
from gazelle.formats import values
from gazelle.formats.reading import Reading

LEAST = 1e-4
"""What Gazebo with DART takes for a length of zero; ODE makes a shape of no thickness [m]."""


def extent(node: Parameters, value: float, what: str, reading: Reading) -> float:
    """A length, radius or side: one of zero is a tenth of a millimetre, a sign is dropped.

    Raises:
        FormatError: It is not finite.
    """
    if value > 0.0 and math.isfinite(value):
        return value
    if not math.isfinite(value):
        raise values.fail(node, f"{what} must be finite, found {value:g}")
    taken = max(abs(value), LEAST)
    reading.fault(f"{what} must be greater than zero, found {value:g}: {taken:g} was taken", node)
    return taken
