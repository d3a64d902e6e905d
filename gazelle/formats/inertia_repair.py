"""Masses and inertias that no body can have, made those of one that can.

Gazebo classic continues with them: ODE cannot invert such an inertia and takes the identity for
its inverse, that is 1 kg m² about every axis, whatever the link weighs. Here the inertia becomes
the nearest one that a body can have. Its second moments of mass, ``s = tr(I) / 2 - I`` about the
principal axes, must be positive (Wensing, Kim and Slotine, "Linear matrix inequalities for
physically consistent inertial parameter identification", IEEE RA-L 3, 2018); those that are not
are raised to those of a ball of water as heavy as the link. Where the file says that the whole
inertia is zero, it is that of the link's shapes, filled evenly.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from gazelle.array_types import Floats
from gazelle.description import Collision, Inertia, Inertial, Parameters
from gazelle.errors import FormatError
from gazelle.formats import values
from gazelle.formats.limits import HEAVIEST
from gazelle.formats.reading import Reading
from gazelle.formats.solids import WATER, solid_of
from gazelle.geometry.solids import joined

_WRONG = "the inertia is not positive definite"
_HINT = "the diagonal must be positive and outweigh the products of inertia"

_ROUNDING = 1e-9
"""Second moments in this proportion are still positive when they are written down."""

TRIANGLE = "inertia-triangle"
"""The rule that moments of inertia obey a + b >= c."""

TRIANGLE_ROUNDING = 1e-3
"""Relative slack on that rule, for figures rounded in a file."""

LEAST_MASS = 1e-3
"""For a mass that is not positive [kg]."""


def valid_inertial(
    inertial: Inertial, collisions: Iterable[Collision], node: Parameters, reading: Reading
) -> Inertial:
    """Return the inertial, or a valid one, with a fault that names the repair.

    An inertia that breaks only the triangle inequality stays, with a note: it can be inverted, and
    ODE takes it as it is.

    Args:
        inertial: As in the file, in the link's frame.
        collisions: Of the link.
        node: Its element, for the fault.
        reading: Takes the fault.
    """
    mass = inertial.mass
    if not 0.0 < mass <= HEAVIEST:
        expected = "greater than zero" if not mass > 0.0 else f"{HEAVIEST:g} kg at most"
        reading.fault(
            f"the mass must be {expected}, found {mass:g}: {LEAST_MASS:g} kg was taken",
            node.find("mass") or node,
        )
        mass = LEAST_MASS
        inertial = replace(inertial, mass=mass)
    inertia = inertial.inertia
    if _is_positive(inertia):
        _note_triangle(inertia, node, reading)
        return inertial
    tensor = _valid_tensor(inertia.matrix(), mass, collisions)
    taken = Inertia.from_matrix(tensor)
    reading.fault(
        f"{_WRONG} ({_numbers(inertia)}): {_numbers(taken)} was taken",
        node.find("inertia") or node,
        _HINT,
    )
    finite = np.isfinite(inertia.matrix()).all()
    return replace(inertial, inertia=taken, written=inertia if finite else None)


def _note_triangle(inertia: Inertia, node: Parameters, reading: Reading) -> None:
    low, middle, high = (float(each) for each in np.linalg.eigvalsh(inertia.matrix()))
    if low + middle < high * (1.0 - TRIANGLE_ROUNDING):
        reading.note(
            f"no body has the principal moments {low:.3g}, {middle:.3g} and {high:.3g} kg m², for "
            "the sum of two must not be below the third: they are simulated as they are, as in "
            "Gazebo",
            node.find("inertia") or node,
            "compute the inertia from the mesh or the shape again",
            rule=TRIANGLE,
        )


def is_valid(inertial: Inertial) -> bool:
    """Return whether the mass is positive and the inertia positive definite."""
    return 0.0 < inertial.mass <= HEAVIEST and _is_positive(inertial.inertia)


def check_inertia(inertia: Inertia, node: Parameters) -> None:
    """Raise an error for a tensor that is not positive definite.

    Raises:
        FormatError: It is not.
    """
    if not _is_positive(inertia):
        raise values.fail(node, f"{_WRONG} ({_numbers(inertia)})", hint=_HINT)


def _is_positive(i: Inertia) -> bool:
    """Return True if a tensor is positive definite (Sylvester's criterion) and within the limits."""
    if not all(abs(each) <= HEAVIEST for each in (i.ixx, i.iyy, i.izz, i.ixy, i.ixz, i.iyz)):
        return False
    minor = i.ixx * i.iyy - i.ixy * i.ixy
    whole = (
        i.izz * minor
        - i.iyz * (i.ixx * i.iyz - i.ixy * i.ixz)
        + i.ixz * (i.ixy * i.iyz - i.iyy * i.ixz)
    )
    return min(i.ixx, i.iyy, i.izz) > 0.0 and minor > 0.0 and whole > 0.0


def _valid_tensor(tensor: Floats, mass: float, collisions: Iterable[Collision]) -> Floats:
    if not (np.abs(tensor) <= HEAVIEST).all():
        tensor = np.zeros((3, 3))
    if not tensor.any():
        filled = _of_shapes(mass, collisions)
        if filled is not None:
            return filled
    moments, axes = np.linalg.eigh(tensor)
    second = moments.sum() / 2.0 - moments
    second = np.maximum(second, max(_ball_of_water(mass) / 2.0, _ROUNDING * np.abs(second).max()))
    repaired: Floats = (axes * (second.sum() - second)) @ axes.T
    return (repaired + repaired.T) / 2.0


def _of_shapes(mass: float, collisions: Iterable[Collision]) -> Floats | None:
    """Return the tensor of the shapes with a uniformly distributed mass; None without a volume."""
    parts = []
    for collision in collisions:
        try:
            solid = solid_of(collision.geometry)
        except FormatError:  # a mesh that cannot be read is reported where it is needed
            continue
        if solid is not None:
            parts.append(solid.placed(collision.pose.matrix()))
    whole = joined(parts)
    if whole is None or not whole.is_body():
        return None
    tensor = whole.scaled(mass / whole.volume).inertia
    return tensor if np.linalg.eigvalsh(tensor)[0] > 0.0 else None


def _ball_of_water(mass: float) -> float:
    """Return the moment of inertia of a ball of water [kg m²]."""
    radius: float = (3.0 * mass / (4.0 * math.pi * WATER)) ** (1.0 / 3.0)
    return 0.4 * mass * radius**2


def _numbers(inertia: Inertia) -> str:
    names = ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")
    return ", ".join(f"{name} {getattr(inertia, name):.6g}" for name in names)
