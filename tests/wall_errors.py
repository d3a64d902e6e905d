"""Deviation of a map's walls from the true ones."""

import numpy as np

from gazelle.description.occupancy import OccupancyMap
from gazelle.navigation.costmap.distances import squared_distances
from gazelle.navigation.localization.scan_likelihood import BeamModel


def distances(walls, grid):
    """Return distances from walls [m], shape (n, 2), to occupied cells of a grid [cells]."""
    near = np.sqrt(squared_distances((grid.data == 100).view(np.uint8)))
    cells = np.floor((walls - [grid.origin.x, grid.origin.y]) / 0.05 + 1e-9).astype(int)
    inside = ((cells >= 0) & (cells < grid.data.shape[::-1])).all(axis=1)
    return near[cells[inside, 1], cells[inside, 0]]


def middles(found, grid):
    """Return middles of some cells of a grid, shape (n, 2) [m]."""
    rows, columns = np.nonzero(found)
    return np.stack((columns, rows), 1) * 0.05 + 0.025 + [grid.origin.x, grid.origin.y]


def seen_walls(true, ideal):
    """Return middles of wall cells that were seen, shape (n, 2) [m]."""
    faces = (true.data == 100) & (squared_distances((true.data == 0).view(np.uint8)) <= 1)
    walls = middles(faces, true)
    return walls[distances(walls, ideal) <= 1.0]


def drawn_walls(found):
    """Return middles of the wall cells of a map, shape (n, 2) [m]."""
    return middles(found.data == 100, found)


def lit(true, places, reach=3.0):
    """Return a map of a laser's view of the walls from some places."""
    model = BeamModel(
        (true.data == 100).view(np.uint8),
        (true.origin.x, true.origin.y),
        0.05,
        np.ones(4),
        0.2,
        0.1,
    )
    cells = np.zeros_like(true.data)
    for x, y in places:
        for angle in np.radians(np.arange(0.0, 360.0, 0.5)):
            far = model.range_at(x, y, angle, reach)
            if far < reach:
                end = (
                    x + far * np.cos(angle) - true.origin.x,
                    y + far * np.sin(angle) - true.origin.y,
                )
                column, row = (int(each / 0.05) for each in end)
                cells[row, column] = 100
    return OccupancyMap(cells, 0.05, true.origin)
