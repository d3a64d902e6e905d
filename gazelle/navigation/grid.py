"""A map of what a laser sees: an occupancy grid of log-odds that grows where it must."""

from __future__ import annotations

import functools

import numpy as np
from numpy.typing import ArrayLike

from gazelle.argument_checks import checked
from gazelle.array_types import Bools, Floats, Indices
from gazelle.errors import SimulationError

# What one scan adds to a cell's log-odds, and how sure a cell may become: two hits make an
# obstacle that some six misses take away again, so that a door that opens is seen.
_HIT = 0.9
_MISS = -0.35
_LEAST = -1.5
_MOST = 2.5
_OBSTACLE = 0.5

MAX_CELLS = 2**26
"""Cells of a map."""

_MARGIN = 1.0  # ground that is added around what must be on the map [m]


@checked(SimulationError)
class OccupancyGrid:
    """Log-odds of being occupied, cell by cell; zero is unknown.

    Method: H. Moravec and A. Elfes, "High resolution maps from wide angle sonar", ICRA 1985,
    with beams for cones, as in Thrun, Burgard and Fox, "Probabilistic Robotics", 2005, ch. 9.

    Args:
        resolution: Length of a cell [m].

    Attributes:
        origin: Corner of the first cell (x, y) [m].
        cells: Log-odds, shape (columns along x, rows along y).

    Raises:
        SimulationError: The resolution is not positive.
    """

    def __init__(self, resolution: float = 0.05) -> None:
        if not resolution > 0.0:
            raise SimulationError(f"the resolution of a map must be positive, not {resolution:g}")
        self.resolution = resolution
        self.origin: Floats = np.zeros(2)
        self.cells: Floats = np.zeros((0, 0))

    @property
    def occupied(self) -> Bools:
        """Cells that hold an obstacle."""
        return self.cells > _OBSTACLE

    def cell_of(self, points: ArrayLike) -> Indices:
        """Return indices of the cells that points are in, shape (..., 2); they may lie outside."""
        scaled = (np.asarray(points, np.float64) - self.origin) / self.resolution
        return np.floor(scaled).astype(np.intp)

    def centre_of(self, cells: ArrayLike) -> Floats:
        """Return the middles of cells [m], shape (..., 2)."""
        return self.origin + (np.asarray(cells, np.float64) + 0.5) * self.resolution

    def include(self, points: ArrayLike) -> None:
        """Extend the map until points, shape (n, 2), are on it, with some margin."""
        places = np.asarray(points, np.float64).reshape(-1, 2)
        if not self.cells.size:
            first = np.floor((places[0] - _MARGIN) / self.resolution)
            self.origin = first * self.resolution
        low = self.cell_of(places.min(axis=0))
        high = self.cell_of(places.max(axis=0)) + 1
        if (low >= 0).all() and (high <= self.cells.shape).all():
            return
        spare = int(np.ceil(_MARGIN / self.resolution))
        before = np.where(low < 0, spare - low, 0)
        after = np.where(high > self.cells.shape, high - self.cells.shape + spare, 0)
        rows, columns = (before + after + self.cells.shape).tolist()
        if rows * columns > MAX_CELLS:
            raise SimulationError(
                f"a map of {rows} x {columns} cells is too large: the most are {MAX_CELLS}",
                hint="the points are far from each other; or take a coarser resolution",
            )
        self.cells = np.pad(self.cells, np.stack((before, after), axis=1))
        self.origin = self.origin - before * self.resolution

    def insert(self, place: ArrayLike, ends: Floats, seen: Bools) -> None:
        """Insert one scan: cells along rays become free, those at their ends occupied.

        Args:
            place: Of the scanner (x, y) [m].
            ends: Ends of rays [m], shape (n, 2).
            seen: Mask of beams with a hit, shape (n,); the others are free up to the end.
        """
        start = np.asarray(place, np.float64)
        self.include(np.concatenate((ends, start[None])))
        along = ends - start
        lengths = np.hypot(along[:, 0], along[:, 1])
        steps = np.arange(0.0, lengths.max(initial=0.0), self.resolution)
        # The last cell before a hit is left alone: a ray that grazes an edge ends in it.
        reach = lengths - np.where(seen, self.resolution, 0.0)
        ray, step = np.nonzero(steps < reach[:, None])
        share = steps[step] / np.maximum(lengths[ray], self.resolution)
        passed = np.zeros(self.cells.shape, np.bool_)
        passed[tuple(self.cell_of(start + share[:, None] * along[ray]).T)] = True
        hit = np.zeros(self.cells.shape, np.bool_)
        hit[tuple(self.cell_of(ends[seen]).T)] = True
        self.cells += np.where(hit, _HIT, np.where(passed, _MISS, 0.0))
        np.clip(self.cells, _LEAST, _MOST, out=self.cells)

    def near_obstacles(self, distance: float) -> Bools:
        """Return cells within a distance [m] of an obstacle."""
        return dilate(self.occupied, distance / self.resolution)

    def is_near(self, points: ArrayLike, distance: float) -> Bools:
        """Return whether points, shape (n, 2), are within a distance [m] of an obstacle; shape (n,).

        The same as ``near_obstacles`` at these points, at a cost that depends on them alone.
        """
        around = self.cell_of(points)[:, None] + _disc(distance / self.resolution)
        limit = np.array(self.cells.shape)
        inside = ((around >= 0) & (around < limit)).all(axis=2)
        found = self.cells[tuple(np.clip(around, 0, limit - 1).transpose(2, 0, 1))] > _OBSTACLE
        near: Bools = (found & inside).any(axis=1)
        return near


@functools.lru_cache(maxsize=8)
def _disc(radius: float) -> Indices:
    """Return offsets of the cells within a radius [cells], shape (n, 2)."""
    reach = np.arange(-int(radius), int(radius) + 1)
    across, along = np.meshgrid(reach, reach, indexing="ij")
    return np.argwhere(across**2 + along**2 <= radius * radius) - int(radius)


def dilate(mask: Bools, radius: float) -> Bools:
    """Return a mask grown by a disc.

    Args:
        mask: Shape (columns, rows).
        radius: Of the disc, in cells.
    """
    reach = int(radius)
    columns, rows = mask.shape
    grown = np.zeros((columns + 2 * reach, rows), np.bool_)
    for offset in range(-reach, reach + 1):
        half = int(np.sqrt(max(radius * radius - offset * offset, 0.0)))
        shifted = grown[reach + offset : reach + offset + columns]
        shifted |= _widened(mask, half)
    return grown[reach : reach + columns]


def _widened(mask: Bools, half: int) -> Bools:
    """Return a mask grown by a given number of cells along its rows, to both sides."""
    rows = mask.shape[1]
    sums = np.zeros((mask.shape[0], rows + 1), np.intp)
    np.cumsum(mask, axis=1, out=sums[:, 1:])
    index = np.arange(rows)
    high = np.minimum(index + half + 1, rows)
    low = np.maximum(index - half, 0)
    return sums[:, high] > sums[:, low]
