"""Frontiers: borders between free and unknown cells of a map.

Method: B. Yamauchi, "A frontier-based approach for autonomous exploration" (1997), with the rules and
costs of ``explore_lite``.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gazelle.array_types import Bools, Bytes, Floats, Indices, Ints64
from gazelle.navigation.costmap.values import FREE_SPACE, NO_INFORMATION
from gazelle.navigation.planners.wavefront import grid_distances

_CLOSED = 254


@dataclass(frozen=True, slots=True)
class Frontier:
    """Unknown cells that touch each other and free ground that can be reached.

    Attributes:
        points: Middles of the cells [m], shape (n, 2).
        centroid: Of them (x, y) [m].
        distance: From the robot to the nearest one, as the crow flies [m].
    """

    points: Floats
    centroid: tuple[float, float]
    distance: float

    @property
    def size(self) -> int:
        """Number of cells."""
        return len(self.points)


def find_frontiers(
    costs: Bytes,
    origin: tuple[float, float],
    resolution: float,
    place: tuple[float, float],
    least: float = 0.0,
) -> list[Frontier]:
    """Return the frontiers that a robot can get to over free cells.

    Args:
        costs: Of a costmap: 0 is free, 255 is unknown, shape (rows, columns).
        origin: Of its lower left corner (x, y) [m].
        resolution: Side of a cell [m].
        place: Of the robot (x, y) [m]; the search begins in the free cell nearest to it.
        least: Shorter ones are left out, a cell being as long as its side [m].
    """
    corner = np.array(origin)
    free = costs == FREE_SPACE
    rows, columns = np.nonzero(free)
    if not len(rows):
        return []
    middles = corner + resolution * (np.stack((columns, rows), axis=1) + 0.5)
    nearest = int(((middles - place) ** 2).sum(axis=1).argmin())
    source = np.array([[columns[nearest], rows[nearest]]], np.intp)
    steps = grid_distances(np.where(free, FREE_SPACE, _CLOSED).astype(np.uint8), source)
    edge = (costs == NO_INFORMATION) & _beside(free)
    cells = np.argwhere(edge)
    if not len(cells):
        return []
    reached = _beside(free & (steps < costs.size))[cells[:, 0], cells[:, 1]]
    labels = connected_cells(cells, costs.shape)
    found = []
    for label in np.unique(labels[reached]):
        own = cells[labels == label]
        points: Floats = corner + resolution * (own[:, ::-1] + 0.5)
        if len(own) * resolution >= least:
            x, y = points.mean(axis=0).tolist()
            away = float(np.hypot(*(points - place).T).min())
            found.append(Frontier(points, (x, y), away))
    return found


def _beside(cells: Bools) -> Bools:
    """Return the cells with one of these on a side."""
    found = np.zeros_like(cells)
    found[1:] |= cells[:-1]
    found[:-1] |= cells[1:]
    found[:, 1:] |= cells[:, :-1]
    found[:, :-1] |= cells[:, 1:]
    return found


def connected_cells(cells: Indices, shape: tuple[int, ...]) -> Ints64:
    """Label the connected components of cells, over corners too: a number for each, shape (n,).

    Method: each takes the least number among its neighbours, and that one's, until none changes.
    """
    index = np.full((shape[0] + 2, shape[1] + 2), -1, np.int64)
    index[cells[:, 0] + 1, cells[:, 1] + 1] = np.arange(len(cells))
    pairs = []
    for down, right in ((0, 1), (1, -1), (1, 0), (1, 1)):
        other = index[cells[:, 0] + 1 + down, cells[:, 1] + 1 + right]
        first = np.flatnonzero(other >= 0)
        pairs.append(np.stack((first, other[first])))
    one, two = np.concatenate(pairs, axis=1)
    labels: Ints64 = np.arange(len(cells), dtype=np.int64)
    while True:
        before = labels.copy()
        least = np.minimum(labels[one], labels[two])
        # Roots are joined, so that whole parts move at once.
        np.minimum.at(labels, before[one], least)
        np.minimum.at(labels, before[two], least)
        labels = labels[labels]
        if np.array_equal(labels, before):
            return labels
