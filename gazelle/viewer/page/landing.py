"""Point of the scene on which a model under the cursor lands."""

from __future__ import annotations

import math

import numpy as np

from gazelle.array_types import Floats, Worlds
from gazelle.simulation import Simulation
from gazelle.viewer.sight import distance_seen

_BEFORE = 0.01  # of a surface that is hit, from where models fall down [m]
_DOWN = np.array([0.0, 0.0, -1.0])


def landing_point(simulation: Simulation, world: Worlds, eye: Floats, along: Floats) -> Floats:
    """Return where a model lands that is dropped before the surface that a ray meets.

    That is a point of the surface if it looks up, the ground before it if it is a wall, and a point
    of z = 0 where the ray meets nothing.

    Args:
        simulation: With any engine.
        world: Number of the world, shape (1,).
        eye: Start of the ray [m], shape (3,).
        along: Direction of the ray, shape (3,).

    Returns:
        Point [m], shape (3,); NaN for none.
    """
    along = along / np.linalg.norm(along)
    reach = distance_seen(simulation, world, eye, along)
    if math.isfinite(reach):
        before = eye + (reach - _BEFORE) * along
        height = distance_seen(simulation, world, before, _DOWN)
        if math.isfinite(height):
            found: Floats = np.round(before + height * _DOWN, 6)
            return found
    return on_level(eye, eye + along, 0.0)


def on_level(eye: Floats, through: Floats, height: float) -> Floats:
    """Intersect a ray from the eye through a point with a height [m]: shape (3,); NaN for none."""
    along = through - eye
    if abs(along[2]) < 1e-6 or (share := (height - eye[2]) / along[2]) <= 0.0:
        return np.full(3, math.nan)
    found: Floats = eye + share * along
    return found
