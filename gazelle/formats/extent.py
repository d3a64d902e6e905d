"""Lengths of shapes that are not greater than zero, as Gazebo takes them."""

from __future__ import annotations

import math

from gazelle.description import Box, Capsule, Cone, Cylinder, Ellipsoid, Parameters, Sphere, Vector3
from gazelle.formats import values
from gazelle.formats.limits import LONGEST
from gazelle.formats.reading import Reading

LEAST = 1e-4
"""Length that Gazebo with DART uses for zero; ODE makes a shape of no thickness [m]."""


Primitive = Box | Sphere | Cylinder | Capsule | Cone | Ellipsoid


def extent(node: Parameters, value: float, what: str, reading: Reading) -> float:
    """Return a length, radius or side: zero becomes a tenth of a millimetre, a sign is dropped.

    Raises:
        FormatError: It is not finite, or too large.
    """
    if 0.0 < value <= LONGEST:
        return value
    if not math.isfinite(value):
        raise values.fail(node, f"{what} must be finite, found {value:g}")
    if abs(value) > LONGEST:
        raise values.fail(node, f"{what} must be {LONGEST:g} m at most, found {value:g}")
    taken = _taken(value)
    reading.fault(f"{what} must be greater than zero, found {value:g}: {taken:g} was taken", node)
    return taken


def scale(node: Parameters, written: Vector3, reading: Reading) -> Vector3:
    """Return the scale of a mesh; a zero in it is reported and kept, as it makes the mesh flat."""
    if 0.0 in written:
        numbers = " ".join(f"{each:g}" for each in written)
        text = f"the scale of a mesh must not be zero, found {numbers}: the mesh has no volume"
        reading.fault(text, node, "1 leaves a side as it is in the file")
    return written


def replaced(*lengths: float) -> tuple[float, ...]:
    """Return the lengths in a file, if others replace some of them; else none."""
    return () if all(length > 0.0 for length in lengths) else lengths


def lengths(shape: Primitive) -> tuple[float, ...]:
    """Return the lengths to write: those of the file, as long as the present ones follow from them."""
    present = _present(shape)
    follows = (
        len(shape.file_lengths) == len(present)
        and tuple(map(_taken, shape.file_lengths)) == present
    )
    return shape.file_lengths if follows else present


def _present(shape: Primitive) -> tuple[float, ...]:
    match shape:
        case Box(size=sides) | Ellipsoid(radii=sides):
            return sides
        case Sphere(radius=radius):
            return (radius,)
        case _:
            return (shape.radius, shape.length)


def _taken(value: float) -> float:
    return value if value > 0.0 else max(abs(value), LEAST)
