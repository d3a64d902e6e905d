"""The hall of the fleet: walls, shelves, places, and a picture of it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from gazelle import formats
from gazelle.array_types import Floats
from gazelle.description import World

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


_HEAD = """\
interval_sim {step}
unit_angle "radians"
define agv position (
  size [ {length} {width} 0.5 ] drive "diff" velocity_bounds [ -9 9 0 0 0 0 -9 9 ]
  ranger ( pose [ 0 0 -0.25 0 ]
    sensor ( range [ 0 {reach} ] fov {fov} samples {samples} pose [ 0 0 0 {ahead} ] ) ) )
"""


def walls() -> Floats:
    """Return the walls and shelves of the hall: size along x and y, and centre [m], shape (n, 4)."""
    x, y = (LENGTH + _WALL) / 2.0, (WIDTH + _WALL) / 2.0
    long, short = LENGTH + 2.0 * _WALL, WIDTH
    frame = [(long, _WALL, 0.0, y), (long, _WALL, 0.0, -y), (_WALL, short, x, 0.0)]
    frame.append((_WALL, short, -x, 0.0))
    return np.array([*frame, *((*_SHELF, *shelf) for shelf in _SHELVES)])


def world(agvs: int, *, step: float, samples: int, reach: float) -> World:
    """Return the hall with AGVs, in Stage's words.

    Args:
        agvs: Number of AGVs; they all stand in the middle.
        step: Of the simulation [s].
        samples: Ranges of each, counter-clockwise all around, from straight ahead.
        reach: Of these [m].
    """
    fov = 2.0 * np.pi * (samples - 1) / samples
    values = {"fov": fov, "ahead": fov / 2.0, "samples": samples, "reach": reach}
    head = _HEAD.format(step=1000.0 * step, length=AGV_LENGTH, width=AGV_WIDTH, **values)
    robots = "".join(f'agv ( name "agv_{number}" )\n' for number in range(agvs))
    things = "".join(
        f"model ( size [ {length} {width} 1 ] pose [ {x} {y} 0 0 ] )\n"
        for length, width, x, y in walls().tolist()
    )
    return formats.load_string(head + robots + things, name="hall")


def places(*, between: bool = False) -> Floats:
    """Return positions of starts and goals [m], shape (n, 2): a grid, clear of all obstacles.

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
    """Render the hall from above, with a line from each AGV to its goal, shape (430, 630, 3)."""
    scale, middle = 20.0, np.array([315.0, 215.0])
    image = Image.new("RGB", (630, 430), (250, 250, 248))
    draw = ImageDraw.Draw(image)

    def path(points: Floats) -> list[tuple[float, float]]:
        pixels = points * [scale, -scale] + middle
        return [(float(x), float(y)) for x, y in pixels]

    for length, width, x, y in walls().tolist():
        corners = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * [length / 2.0, width / 2.0]
        draw.polygon(path(corners + np.array([x, y])), fill=(60, 60, 66))
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
