"""Axes and limits of joints that make no sense, as Gazebo's ODE takes them."""

from __future__ import annotations

import math

from gazelle.description import Parameters, Vector3
from gazelle.formats import values
from gazelle.formats.reading import Reading

_FALLBACK = (1.0, 0.0, 0.0)
"""Vector by which ODE replaces one of length zero (``dSafeNormalize3``)."""


def direction(xyz: Vector3, node: Parameters, reading: Reading) -> Vector3:
    """Return the vector at length one; x for one without length.

    Raises:
        FormatError: It is not finite.
    """
    if any(xyz):
        return values.unit(node, xyz)
    reading.fault(f"<{node.tag}> must be a vector of some length, found 0 0 0: x was taken", node)
    return _FALLBACK


def travel(lower: float, upper: float, node: Parameters, reading: Reading) -> tuple[float, float]:
    """Return the limits of a joint; ODE has none if the lower one is above the upper."""
    if lower <= upper:
        return lower, upper
    reading.fault(
        f"the lower limit {lower:g} is greater than the upper limit {upper:g}: the joint has none",
        node,
        "swap the two limits, or leave them out",
    )
    return -math.inf, math.inf
