"""The lights of a description for the rasteriser."""

from __future__ import annotations

import math
from collections.abc import Iterable
from functools import cache

import numpy as np

from gazelle.array_types import Bytes, Floats
from gazelle.description import Light, World
from gazelle.rendering import columns as c
from gazelle.rendering.lighting import Lighting

SUN = Light("sun", "directional", direction=(-0.5, 0.1, -0.9), diffuse=(0.8, 0.8, 0.8, 1.0))
"""Light of a world that has none."""

SKY_TOP = (0.45, 0.62, 0.86)
SKY_HORIZON = (0.86, 0.91, 0.96)
_KINDS = {"directional": c.DIRECTIONAL, "point": c.POINT, "spot": c.SPOT}
_TONES = 4096


def lighting_of(world: World, *, gamma: float = 1.0) -> Lighting:
    """Return the lighting of a world.

    Args:
        world: World of the lights and sky.
        gamma: Brightness b becomes b to the power 1 / gamma; above 1 it lifts the shadows.
    """
    back = SKY_HORIZON if world.scene.sky else world.scene.background[:3]
    top = SKY_TOP if world.scene.sky else back
    return Lighting(
        table_of(world.lights or (SUN,)),
        np.array(world.scene.ambient[:3], np.float64),
        np.array(top, np.float64),
        np.array(back, np.float64),
        tones(gamma),
    )


def table_of(lights: Iterable[Light]) -> Floats:
    """Return the lamps in rows, by ``columns.KIND`` and those that follow, shape (n, LAMP)."""
    rows = [_row(light) for light in lights]
    return np.array(rows, np.float64).reshape(-1, c.LAMP)


@cache
def tones(gamma: float) -> Bytes:
    """Return bytes for brightnesses from 0 to 1, evenly spaced."""
    share = np.linspace(0.0, 1.0, _TONES) ** (1.0 / gamma)
    return np.asarray(share * 255.0 + 0.5, np.uint8)


def _row(light: Light) -> list[float]:
    along = np.asarray(light.pose.rotate(light.direction), np.float64)
    along = along / max(float(np.linalg.norm(along)), 1e-12)
    color = np.asarray(light.diffuse[:3]) * light.intensity
    fade = light.attenuation
    return [
        _KINDS[light.type],
        *light.pose.position,
        *along,
        *color,
        fade.range,
        fade.constant,
        fade.linear,
        fade.quadratic,
        math.cos(light.spot_inner_angle / 2.0),
        math.cos(light.spot_outer_angle / 2.0),
    ]
