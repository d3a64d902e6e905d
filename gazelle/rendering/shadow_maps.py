"""Depth pictures from a directional lamp, for shadows.

A point is in shadow if the lamp's picture shows something nearer to the lamp there (L. Williams,
"Casting curved shadows on curved surfaces", 1978); four neighbouring pixels are sampled, so that edges
are soft (W. T. Reeves et al., "Rendering antialiased shadows with depth maps", 1987). The lamp is put so
far away that its rays are all but parallel.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gazelle.array_types import Floats
from gazelle.description import Light
from gazelle.rendering import columns as c
from gazelle.rendering.lens import PinholeLens
from gazelle.rendering.rasterizer import DrawnShapes

FARTHEST = 12.0
"""Half the side of what has shadows at most [m]; a larger world has them before each camera."""

_LEAST, _MOST = 256, 2048
_GROUND = 30.0  # what is larger than this catches shadows, and throws none that matter [m]
_AWAY = 100.0  # of the lamp, in halves of the side
_BEFORE = 0.7  # of half the side, from a camera to the middle of what has shadows


@dataclass(frozen=True, slots=True)
class ShadowMaps:
    """The lamp's pictures for some cameras.

    Attributes:
        lamp: Number of the lamp among those of the world.
        cameras: Of the lamp, as ``columns.CAMERA`` says, shape (n, CAMERA).
        turns: From the frame of each camera to the lamp's: rotation by rows and place [m], (n, 12).
        lens: As `Rasterizer` wants it.
        side: Pixels along a side.
        pixel: Side of a pixel where it falls [m].
    """

    lamp: int
    cameras: Floats
    turns: Floats
    lens: tuple[float, float, float, float, float, float]
    side: int
    pixel: float


def casting_lamp(lights: tuple[Light, ...]) -> int | None:
    """Return the first directional light that casts shadows, as in Gazebo; None without one."""
    for number, light in enumerate(lights):
        if light.type == "directional" and light.cast_shadows:
            return number
    return None


def side_of(lens: PinholeLens) -> int:
    """Return the pixels along a side of the lamp's picture: twice as many as the camera's."""
    return min(_MOST, max(_LEAST, 2 * max(lens.width, lens.height)))


def extent_of_shapes(shapes: DrawnShapes, placed: Floats) -> tuple[Floats, float]:
    """Return middle (3,) and radius [m] of a ball around everything except ground.

    Args:
        shapes: Shapes to draw.
        placed: Rotation by rows and place of the links [m], shape (nlink, 12).
    """
    parts, spheres = np.asarray(shapes.parts), np.asarray(shapes.spheres)
    balls = spheres[parts[:, c.MESH_OF_PART]]
    local, link = np.asarray(shapes.local), placed[parts[:, c.LINK_OF_PART]]
    at = _moved(link, _moved(local, balls[:, :3]))
    kept = balls[:, 3] < _GROUND
    if not kept.any():
        return np.zeros(3), 1.0
    at, radii = at[kept], balls[kept, 3:]
    low, high = (at - radii).min(axis=0), (at + radii).max(axis=0)
    return (low + high) / 2.0, max(1.0, float(np.linalg.norm(high - low)) / 2.0)


def shadow_maps(
    cameras: Floats, lamp: int, along: Floats, extent: tuple[Floats, float], side: int
) -> ShadowMaps:
    """Create the cameras of the lamp's pictures for these cameras.

    Args:
        cameras: As ``columns.CAMERA`` says, shape (n, CAMERA).
        lamp: Its number.
        along: Direction of its light, of unit length, shape (3,).
        extent: Middle (3,) and radius [m] of the world.
        side: Pixels along a side.
    """
    middle, radius = extent
    half = min(radius, FARTHEST)
    middles = np.tile(middle, (len(cameras), 1))
    if radius > FARTHEST:
        middles = cameras[:, 1:4] + _BEFORE * half * cameras[:, 10:13]
    frame = _frame(np.asarray(along))
    made = np.empty_like(cameras)
    made[:, 0], made[:, 1:4] = cameras[:, 0], middles - _AWAY * half * frame[2]
    made[:, 4:13], made[:, c.UNSEEN] = frame.ravel(), -1.0
    turns = np.empty((len(cameras), 12))
    axes = cameras[:, 4:13].reshape(-1, 3, 3)
    turns[:, :9] = np.einsum("ij,nkj->nik", frame, axes).reshape(-1, 9)
    turns[:, 9:] = (cameras[:, 1:4] - made[:, 1:4]) @ frame.T
    focal = 0.5 * side * _AWAY
    lens = (focal, focal, 0.5 * side, 0.5 * side, 0.5 * _AWAY * half, 2.0 * _AWAY * half)
    return ShadowMaps(lamp, made, turns, lens, side, 2.0 * half / side)


def _frame(along: Floats) -> Floats:
    """Return axes of a camera that looks along a direction, by rows: right, down, forward."""
    other = np.eye(3)[int(np.argmin(np.abs(along)))]
    right = np.cross(along, other)
    right /= np.linalg.norm(right)
    return np.stack((right, np.cross(along, right), along))


def _moved(rows: Floats, points: Floats) -> Floats:
    turned: Floats = np.einsum("nij,nj->ni", rows[:, :9].reshape(-1, 3, 3), points)
    return turned + rows[:, 9:]
