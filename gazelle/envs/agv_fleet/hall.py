"""The hall of the fleet: walls, shelves, places, and a picture of it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from gazelle.array_types import Floats
from gazelle.engines.planar import Part

LENGTH, WIDTH = 30.0, 20.0
"""Of the hall, inside, along x and y [m]; its middle is the origin."""

AGV_LENGTH, AGV_WIDTH = 0.8, 0.5
APART = 1.2
"""Middles of AGVs that start are farther apart than this [m]."""

_WALL = 0.2
_SHELVES = tuple((x, y) for y in (-4.0, 4.0) for x in (-9.0, -3.0, 3.0, 9.0))
_SHELF = (3.0, 1.5)
_CLEAR = 1.0  # of places from walls and shelves [m]
_SPACING = 1.5  # of places [m]


def walls() -> tuple[Part, ...]:
    """What stands in the hall."""
    x, y = (LENGTH + _WALL) / 2.0, (WIDTH + _WALL) / 2.0
    return (
        Part.box(LENGTH + 2.0 * _WALL, _WALL, 0.0, y),
        Part.box(LENGTH + 2.0 * _WALL, _WALL, 0.0, -y),
        Part.box(_WALL, WIDTH, x, 0.0),
        Part.box(_WALL, WIDTH, -x, 0.0),
        *(Part.box(*_SHELF, *shelf) for shelf in _SHELVES),
    )


def places(*, between: bool = False) -> Floats:
    """Where AGVs start and goals are [m], shape (n, 2): a grid, clear of all that stands.

    Args:
        between: Those in the middles of the grid's squares instead.
    """
    first = _CLEAR + 0.5 * _SPACING * between
    x = np.arange(-LENGTH / 2.0 + first, LENGTH / 2.0 - _CLEAR + 1e-9, _SPACING)
    y = np.arange(-WIDTH / 2.0 + first, WIDTH / 2.0 - _CLEAR + 1e-9, _SPACING)
    grid = np.stack(np.meshgrid(x, y, indexing="ij"), axis=-1).reshape(-1, 2)
    away = np.abs(grid[:, None, :] - np.array(_SHELVES)) - np.array(_SHELF) / 2.0
    free: Floats = grid[~(away < _CLEAR).all(axis=2).any(axis=1)]
    return free


def picture(poses: Floats, goals: Floats) -> NDArray[np.uint8]:
    """The hall from above with its AGVs, each with a line to its goal, shape (430, 630, 3)."""
    scale, middle = 20.0, np.array([315.0, 215.0])
    image = Image.new("RGB", (630, 430), (250, 250, 248))
    draw = ImageDraw.Draw(image)

    def path(points: Floats) -> list[tuple[float, float]]:
        pixels = points * [scale, -scale] + middle
        return [(float(x), float(y)) for x, y in pixels]

    for part in walls():
        draw.polygon(path(np.array(part.points)), fill=(60, 60, 66))
    half = np.array([AGV_LENGTH, AGV_WIDTH]) / 2.0
    corners = half * [[1.0, 0.0], [0.6, 1.0], [-1.0, 1.0], [-1.0, -1.0], [0.6, -1.0]]
    for (x, y, yaw), goal in zip(poses, goals, strict=True):
        cos, sin = np.cos(yaw), np.sin(yaw)
        here = np.array([x, y])
        draw.line(path(np.array([here, goal])), fill=(235, 190, 180))
        ((u, v),) = path(goal[None])
        draw.ellipse((u - 3, v - 3, u + 3, v + 3), fill=(206, 62, 52))
        draw.polygon(path(corners @ [[cos, sin], [-sin, cos]] + here), fill=(55, 110, 175))
    return np.asarray(image, np.uint8)
