"""Distance to the nearest visual along a ray, with any engine."""

from __future__ import annotations

import numpy as np

from gazelle.array_types import Floats, Worlds
from gazelle.rendering import PinholeLens
from gazelle.sensors import look_at
from gazelle.simulation import Simulation

_PIXEL = PinholeLens(1, 1, horizontal_fov=1e-3)


def distance_seen(simulation: Simulation, world: Worlds, start: Floats, along: Floats) -> float:
    """Return the distance from a point to the nearest visual [m]; infinite for none.

    Args:
        simulation: With any engine.
        world: Number of the world, shape (1,).
        start: Point [m], shape (3,).
        along: Unit vector, shape (3,).
    """
    x, y, z = along.tolist()
    turned = look_at((0.0, 0.0, 0.0), (x, y, z)).quaternion
    eye = start - _PIXEL.near * along
    frames = simulation.live_scene.render(
        _PIXEL, eye[None], np.array([turned]), world, want=("depth",)
    )
    return float(frames.depth[0, 0, 0]) - _PIXEL.near
