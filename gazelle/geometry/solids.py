"""Volume, centre and inertia of bodies filled with matter of even density.

Closed forms of the simple ones; of closed surfaces from signed tetrahedra (Tonon, "Explicit exact
formulas for the 3-D tetrahedron inertia tensor", Journal of Mathematics and Statistics 1,
2004). Simple ones stand at the origin with their axis along z.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats


@dataclass(frozen=True, slots=True)
class UnitSolid:
    """A body of density 1 kg/m³.

    Attributes:
        volume: [m³]; of one that is scaled by a density, its mass [kg].
        center: Centre of mass [m], shape (3,).
        inertia: About the centre of mass [m⁵], shape (3, 3).
    """

    volume: float
    center: Floats
    inertia: Floats

    def is_body(self) -> bool:
        """Return whether it has a volume, and all its numbers are finite."""
        finite = math.isfinite(self.volume) and bool(np.isfinite(self.inertia).all())
        return finite and self.volume > 0.0

    def placed(self, frame: Floats) -> UnitSolid:
        """Return the same body in the frame above its own, by its pose there, shape (4, 4)."""
        turn = frame[:3, :3]
        center: Floats = turn @ self.center + frame[:3, 3]
        inertia: Floats = turn @ self.inertia @ turn.T
        return UnitSolid(self.volume, center, inertia)

    def scaled(self, density: float) -> UnitSolid:
        """Return the same body with its volume and inertia times a density [kg/m³]."""
        return UnitSolid(self.volume * density, self.center, self.inertia * density)


def joined(solids: Iterable[UnitSolid]) -> UnitSolid | None:
    """Return several bodies as one (parallel axis theorem); None if there is none."""
    parts = list(solids)
    volume = sum(part.volume for part in parts)
    if volume <= 0.0:
        return None
    center = sum((part.volume * part.center for part in parts), np.zeros(3)) / volume
    inertia = np.zeros((3, 3))
    for part in parts:
        away = part.center - center
        inertia += part.inertia + part.volume * (away @ away * np.eye(3) - np.outer(away, away))
    return UnitSolid(volume, center, inertia)


def box(size: tuple[float, float, float]) -> UnitSolid:
    """Return a box with edges of some lengths [m]."""
    x, y, z = size
    return _even(
        x * y * z, ((y * y + z * z) / 12.0, (x * x + z * z) / 12.0, (x * x + y * y) / 12.0)
    )


def ellipsoid(radii: tuple[float, float, float]) -> UnitSolid:
    """Return an ellipsoid with half axes [m]."""
    a, b, c = radii
    moments = ((b * b + c * c) / 5.0, (a * a + c * c) / 5.0, (a * a + b * b) / 5.0)
    return _even(4.0 / 3.0 * math.pi * a * b * c, moments)


def cylinder(r: float, h: float) -> UnitSolid:
    """Return a cylinder of a radius and a length [m]."""
    across = r * r / 4.0 + h * h / 12.0
    return _even(math.pi * r * r * h, (across, across, r * r / 2.0))


def capsule(r: float, h: float) -> UnitSolid:
    """Return a cylinder and two half balls with centres 3/8 r beyond its ends."""
    tube, balls = math.pi * r * r * h, 4.0 / 3.0 * math.pi * r**3
    across = tube * (r * r / 4.0 + h * h / 12.0)
    across += balls * (0.4 * r * r + h * h / 4.0 + 3.0 / 8.0 * h * r)
    along = tube * r * r / 2.0 + balls * 0.4 * r * r
    return UnitSolid(tube + balls, np.zeros(3), np.diag((across, across, along)))


def cone(r: float, h: float) -> UnitSolid:
    """Return a cone of a radius and a length [m], with its middle at the origin."""
    across = 3.0 / 80.0 * (4.0 * r * r + h * h)
    return _even(math.pi * r * r * h / 3.0, (across, across, 0.3 * r * r), z=-h / 4.0)


def solid_of_triangles(vertices: Floats, faces: NDArray[np.int32]) -> UnitSolid:
    """Return the body within closed triangles that look outwards, as signed tetrahedra.

    Args:
        vertices: Corners [m], shape (n, 3).
        faces: Their numbers, shape (m, 3).
    """
    middle = (vertices.min(axis=0) + vertices.max(axis=0)) / 2.0
    corners = (vertices - middle)[faces]
    volumes = np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6.0
    volume = float(volumes.sum())
    if volume <= 0.0:
        return UnitSolid(0.0, middle, np.zeros((3, 3)))
    total = corners.sum(axis=1)
    center = (volumes[:, None] * total).sum(axis=0) / 4.0 / volume
    second = np.einsum("i,ij,ik->jk", volumes, total, total)
    second = (second + np.einsum("i,icj,ick->jk", volumes, corners, corners)) / 20.0
    second -= volume * np.outer(center, center)
    inertia: Floats = np.trace(second) * np.eye(3) - second
    return UnitSolid(volume, center + middle, inertia)


def _even(volume: float, moments: tuple[float, float, float], z: float = 0.0) -> UnitSolid:
    return UnitSolid(volume, np.array([0.0, 0.0, z]), np.diag(moments) * volume)
