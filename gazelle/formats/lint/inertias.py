"""Masses and inertias that no engineer would sign."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from gazelle.description import (
    Box,
    Capsule,
    Cylinder,
    Ellipsoid,
    Geometry,
    Inertia,
    Inertial,
    Link,
    Sphere,
    World,
)
from gazelle.formats.inertia_repair import TRIANGLE, TRIANGLE_ROUNDING
from gazelle.formats.lint.diagnostic import Diagnostic, moving_links_of
from gazelle.formats.solids import solid_of

# An inertia this many times off the one of a solid of the link's shape is a typing error.
_FACTOR = 10.0

# Masses of joined links this far apart make constraint solvers slow and soft.
_MASS_RATIO = 1e4

_SIMPLE = (Box, Capsule, Cylinder, Ellipsoid, Sphere)


def lint(world: World) -> Iterator[Diagnostic]:
    """Yield findings on every link that moves."""
    for place in moving_links_of(world):
        name = f"{place.scope}::{place.link.name}"
        inertial = place.link.inertial
        if inertial is None:
            yield Diagnostic(
                "no-inertial",
                f"link '{name}' moves and has no <inertial>; it gets 1 kg and 1 kg m²",
                "a small part with an inertia of 1 kg m² turns as if it were a metre wide",
                "add an <inertial> with its mass and inertia",
                place.link.source,
            )
            continue
        yield from _most_suspicious(name, place.link, inertial)
    yield from _mass_ratios(world)


def _most_suspicious(name: str, link: Link, inertial: Inertial) -> Iterator[Diagnostic]:
    """Yield at most one finding on a link; none if the reader has replaced the inertia."""
    if inertial.written is None:
        found = [*_triangle(name, inertial), *_compared_with_shape(name, link, inertial)]
        yield from found[:1]


def principal_moments(inertia: Inertia) -> tuple[float, float, float]:
    """Return principal moments of inertia, smallest first [kg m²]."""
    tensor = inertia.matrix()
    if not np.isfinite(tensor).all():
        return (math.nan, math.nan, math.nan)
    low, middle, high = np.linalg.eigvalsh(tensor)
    return (float(low), float(middle), float(high))


def solid_moments(shape: Geometry, mass: float) -> tuple[float, float, float] | None:
    """Return principal moments of a solid of even density, smallest first [kg m²].

    None if unknown.
    """
    # Others are seldom in files, and a mesh is a hull as often as it is the part itself.
    solid = solid_of(shape) if isinstance(shape, _SIMPLE) else None
    if solid is None:
        return None
    return principal_moments(Inertia.from_matrix(solid.scaled(mass / solid.volume).inertia))


def _triangle(name: str, inertial: Inertial) -> Iterator[Diagnostic]:
    low, middle, high = principal_moments(inertial.inertia)
    if low + middle < high * (1.0 - TRIANGLE_ROUNDING):
        yield Diagnostic(
            TRIANGLE,
            f"link '{name}': the principal moments {low:.3g}, {middle:.3g} and {high:.3g} kg m² "
            "are those of no body: the sum of two must not be below the third",
            "engines simulate, bend or refuse such an inertia, each in its own way",
            "compute the inertia from the mesh or the shape again",
            inertial.source,
        )


def _compared_with_shape(name: str, link: Link, inertial: Inertial) -> Iterator[Diagnostic]:
    """Yield findings on links of one simple collision, which compare with a solid."""
    if len(link.collisions) != 1:
        return
    expected = solid_moments(link.collisions[0].geometry, inertial.mass)
    actual = principal_moments(inertial.inertia)
    if expected is None or min(actual) <= 0.0:
        return
    if not all(map(math.isfinite, (*expected, *actual))):
        return
    ratios = [a / e for a, e in zip(actual, expected, strict=True) if e > 0.0]
    if not ratios or (max(ratios) <= _FACTOR and min(ratios) >= 1.0 / _FACTOR):
        return
    worst = max(ratios, key=lambda ratio: abs(math.log(max(ratio, 1e-300))))
    times = f"{_plain(worst)} times" if worst > 1.0 else f"1/{_plain(1.0 / max(worst, 1e-300))} of"
    yield Diagnostic(
        "inertia-off",
        f"link '{name}': its inertia is {times} that of a solid of its shape and mass "
        f"({inertial.mass:g} kg; expected about {expected[0]:.3g}, {expected[1]:.3g}, "
        f"{expected[2]:.3g} kg m²)",
        "too much makes it sluggish, too little makes it shake in contact",
        "check the units (g and mm?) or use the moments named",
        inertial.source,
    )


def _plain(factor: float) -> str:
    """Return a factor with three significant digits, written as 1,630 and not 1.63e+03."""
    return f"{float(f'{factor:.3g}'):,.10g}" if factor < 1e9 else f"{factor:.3g}"


def _mass_ratios(world: World) -> Iterator[Diagnostic]:
    for model in world.models:
        if model.static:
            continue
        for placed in model.walk():
            masses = {link.name: (link.inertial or Inertial()).mass for link in placed.model.links}
            for joint in placed.model.joints:
                pair = [masses.get(joint.parent), masses.get(joint.child)]
                known = [mass for mass in pair if mass is not None and mass > 0.0]
                if len(known) == 2 and max(known) / min(known) > _MASS_RATIO:
                    yield Diagnostic(
                        "mass-ratio",
                        f"joint '{placed.scope}::{joint.name}' joins {known[0]:g} kg to "
                        f"{known[1]:g} kg",
                        "a joint between masses far apart is soft and slow to solve",
                        "give the light link a mass nearer to the heavy one's, or fix it",
                        joint.source,
                    )
