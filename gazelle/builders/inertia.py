"""Volume and inertia of shapes, and of bodies put together from them.

The formulas are those of solid mechanics for uniform density: H. Goldstein, "Classical
Mechanics", and for the capsule a cylinder with two half spheres, by the parallel axis theorem.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.builders.errors import BuildError, positive
from gazelle.description import (
    Box,
    Capsule,
    Cone,
    Cylinder,
    Ellipsoid,
    Geometry,
    Inertia,
    Inertial,
    Pose,
    Sphere,
    Vector3,
)


def volume(shape: Geometry) -> float:
    """Volume of a solid shape [m³].

    Raises:
        BuildError: The shape has no volume that a formula gives: a plane, a mesh, ...
    """
    return _entry(shape)[0](shape)


def moments(shape: Geometry) -> Vector3:
    """Moments of a shape of one kilogram about its centre of mass, along x, y, z [m²].

    Raises:
        BuildError: The shape has no formula.
    """
    return _entry(shape)[1](shape)


def mass_center(shape: Geometry) -> Vector3:
    """The centre of mass in the frame of the shape [m]: a cone's is a quarter up from its base."""
    return (0.0, 0.0, -shape.length / 4.0) if isinstance(shape, Cone) else (0.0, 0.0, 0.0)


def solid_inertial(parts: Sequence[tuple[Geometry, Pose]], mass: float) -> Inertial:
    """Mass and inertia of a body of one density, from its shapes and their poses.

    Where shapes overlap, the common volume counts twice.

    Args:
        parts: Shapes, each with its pose in the link frame.
        mass: Of the whole body [kg].

    Raises:
        BuildError: The mass is not positive, or a shape has no formula.
    """
    positive(mass, "the mass")
    volumes = np.array([volume(shape) for shape, _ in parts])
    if not volumes.size:
        raise BuildError("a body without shapes has no inertia")
    masses = mass * volumes / volumes.sum()
    centers = np.array([pose.apply(mass_center(shape)) for shape, pose in parts])
    center = masses @ centers / mass
    tensor = np.zeros((3, 3))
    for (shape, pose), share, place in zip(parts, masses, centers, strict=True):
        turn = pose.matrix()[:3, :3]
        offset = place - center
        tensor += share * (turn @ np.diag(moments(shape)) @ turn.T)
        tensor += share * (offset @ offset * np.eye(3) - np.outer(offset, offset))
    return Inertial(mass, Pose(*center), _inertia(tensor))


def _inertia(tensor: NDArray[np.float64]) -> Inertia:
    xx, xy, xz, _, yy, yz, __, ___, zz = (float(value) for value in tensor.ravel())
    return Inertia(ixx=xx, iyy=yy, izz=zz, ixy=xy, ixz=xz, iyz=yz)


def _box_moments(box: Box) -> Vector3:
    x, y, z = (length * length / 12.0 for length in box.size)
    return (y + z, x + z, x + y)


def _cylinder_moments(cylinder: Cylinder) -> Vector3:
    across = (3.0 * cylinder.radius**2 + cylinder.length**2) / 12.0
    return (across, across, cylinder.radius**2 / 2.0)


def _cone_moments(cone: Cone) -> Vector3:
    across = 3.0 / 20.0 * cone.radius**2 + 3.0 / 80.0 * cone.length**2
    return (across, across, 0.3 * cone.radius**2)


def _ellipsoid_moments(ellipsoid: Ellipsoid) -> Vector3:
    x, y, z = (radius * radius / 5.0 for radius in ellipsoid.radii)
    return (y + z, x + z, x + y)


def _sphere_moments(sphere: Sphere) -> Vector3:
    moment = 0.4 * sphere.radius**2
    return (moment, moment, moment)


def _capsule_volume(capsule: Capsule) -> float:
    return math.pi * capsule.radius**2 * (capsule.length + 4.0 / 3.0 * capsule.radius)


def _capsule_moments(capsule: Capsule) -> Vector3:
    r, h = capsule.radius, capsule.length
    middle = h / (h + 4.0 / 3.0 * r)
    ends = 1.0 - middle
    # A half sphere's centre of mass is 3/8 r from its flat side.
    shifted = 0.4 * r * r + h * h / 4.0 + 3.0 / 8.0 * h * r
    across = middle * (3.0 * r * r + h * h) / 12.0 + ends * shifted
    return (across, across, middle * r * r / 2.0 + ends * 0.4 * r * r)


_FORMULAS: dict[type, tuple[Callable[[Any], float], Callable[[Any], Vector3]]] = {
    Box: (lambda s: math.prod(s.size), _box_moments),
    Capsule: (_capsule_volume, _capsule_moments),
    Cone: (lambda s: math.pi * s.radius**2 * s.length / 3.0, _cone_moments),
    Cylinder: (lambda s: math.pi * s.radius**2 * s.length, _cylinder_moments),
    Ellipsoid: (lambda s: 4.0 / 3.0 * math.pi * math.prod(s.radii), _ellipsoid_moments),
    Sphere: (lambda s: 4.0 / 3.0 * math.pi * s.radius**3, _sphere_moments),
}


def _entry(shape: Geometry) -> tuple[Callable[[Any], float], Callable[[Any], Vector3]]:
    if type(shape) not in _FORMULAS:
        kind = type(shape).__name__.lower()
        raise BuildError(f"a {kind} has no formula for its inertia", hint="give the inertial")
    return _FORMULAS[type(shape)]
