"""Maps of ROS's ``map_server`` as worlds: a wall on every cell that is occupied."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gazelle.description import (
    Box,
    Collision,
    Light,
    Link,
    Material,
    Model,
    Plane,
    Pose,
    Visual,
    World,
)
from gazelle.description.occupancy import OccupancyMap
from gazelle.errors import FormatError
from gazelle.formats.terrain import rectangles

SOLID = 65
"""Least value of a cell that is a wall; of what ``map_server`` publishes all occupied ones are."""
HEIGHT = 1.0
"""Of the walls [m]; a map has no height."""
MAX_BOXES = 100_000

_GREY = Material(ambient=(0.5, 0.5, 0.5, 1.0), diffuse=(0.5, 0.5, 0.5, 1.0))


def map_world(grid: OccupancyMap, *, height: float = HEIGHT) -> World:
    """Return the world of a map: its frame is the map's, unknown cells are free.

    Args:
        grid: The map.
        height: Of the walls [m].

    Raises:
        FormatError: The map has too many walls for a world.
    """
    boxes = rectangles(_walls(grid))
    if len(boxes) > MAX_BOXES:
        raise FormatError(
            f"the map '{grid.name}' has walls of {len(boxes)} boxes, more than {MAX_BOXES}",
            source=grid.source,
            hint="a map without speckles, or with larger cells, has fewer",
        )
    collisions, visuals = [], []
    for index, (left, low, right, high) in enumerate((boxes * grid.resolution).tolist()):
        shape = Box((right - left, high - low, height))
        pose = Pose((left + right) / 2.0, (low + high) / 2.0, height / 2.0)
        collisions.append(Collision(f"wall_{index}", shape, pose))
        visuals.append(Visual(f"wall_{index}", shape, pose, material=_GREY))
    link = Link("link", collisions=tuple(collisions), visuals=tuple(visuals))
    walls = Model("walls", pose=grid.origin, static=True, links=(link,), source=grid.source)
    return World(
        name=grid.name,
        models=(_ground(), walls),
        lights=(Light("sun", type="directional", pose=Pose(z=10.0), direction=(0.3, 0.2, -1.0)),),
        source=grid.source,
    )


def _walls(grid: OccupancyMap) -> NDArray[np.bool_]:
    walls: NDArray[np.bool_] = grid.data >= SOLID
    return walls


def _ground() -> Model:
    look = Visual("visual", Plane(size=(100.0, 100.0)), material=_GREY)
    link = Link("link", collisions=(Collision("collision", Plane()),), visuals=(look,))
    return Model("ground_plane", static=True, links=(link,))
