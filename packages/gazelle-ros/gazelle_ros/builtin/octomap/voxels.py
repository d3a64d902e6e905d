"""Occupied and free cells, by the likelihoods of OctoMap.

Hornung et al., "OctoMap: An Efficient Probabilistic 3D Mapping Framework Based on Octrees",
Autonomous Robots, 2013.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gazelle_ros.base.array_types import Bools, Floats, Ints64
from gazelle_ros.base.errors import RosError
from gazelle_ros.builtin.octomap.morton import DEPTH, ORIGIN, decode, encode
from gazelle_ros.builtin.octomap.rays import crossed


@dataclass(frozen=True, slots=True)
class HitModel:
    """Probabilities of a sensor.

    Attributes:
        hit: Probability of a hit in an occupied cell.
        miss: Probability of a hit in a crossed cell.
        least: Least probability of a cell.
        most: Greatest one.
        max_range: Points farther off only free what is before that [m]; none if negative.
        min_range: Nearer points are left out [m]; none if negative.
    """

    hit: float = 0.7
    miss: float = 0.4
    least: float = 0.12
    most: float = 0.97
    max_range: float = -1.0
    min_range: float = -1.0

    def __post_init__(self) -> None:
        if not 0.0 < self.least < self.miss < 0.5 < self.hit < self.most < 1.0:
            raise RosError(
                "probabilities of a sensor_model are 0 < min < miss < 0.5 < hit < max < 1, not "
                f"{self.least}, {self.miss}, {self.hit}, {self.most}"
            )


class VoxelMap:
    """Log odds of cells, of those that have been seen.

    Args:
        resolution: Side of a cell [m].
        sensor: Of the points.

    Attributes:
        resolution: Side of a cell [m].
        codes: Of the cells, ascending.
        values: Log odds of being occupied, shape (n,).
    """

    def __init__(self, resolution: float, sensor: HitModel) -> None:
        self.resolution = resolution
        self.codes: Ints64 = np.zeros(0, np.int64)
        self.values: NDArray[np.float32] = np.zeros(0, np.float32)
        self._sensor = sensor
        self._hit, self._miss = _log_odds(sensor.hit), _log_odds(sensor.miss)
        self._least, self._most = _log_odds(sensor.least), _log_odds(sensor.most)

    @property
    def occupied(self) -> Bools:
        """True for cells rather occupied than free, shape (n,)."""
        return self.values >= 0.0

    def insert(self, origin: Floats, points: Floats, ground: Floats | None = None) -> None:
        """Add points that a sensor saw at the same time.

        A cell counts once: as occupied if it has a point, else as free if a ray crosses it.

        Args:
            origin: Place of the sensor [m], shape (3,).
            points: Shape (n, 3) [m].
            ground: Points that only free what is before them, shape (m, 3) [m].
        """
        floor = np.zeros((0, 3)) if ground is None else ground
        points, floor = (self._away(origin, each) for each in (points, floor))
        start = origin / self.resolution
        near, cut = self._within_range(start, points)
        hits, ends = self._ends(near)
        open_cells, open_ends = self._ends(cut)
        floor_ends = np.concatenate(self._within_range(start, floor))
        passed = crossed(start, np.concatenate((ends, open_ends, floor_ends))) + ORIGIN
        inside = ((passed >= 0) & (passed < 1 << DEPTH)).all(axis=1)
        free = np.concatenate((encode(passed[inside]), open_cells))
        free.sort()  # which takes less time than finding those that are there twice by their hashes
        fresh = ~_contains(hits, free)
        fresh[1:] &= free[1:] != free[:-1]
        self._update(free[fresh], self._miss)
        self._update(hits, self._hit)

    def _away(self, origin: Floats, points: Floats) -> Floats:
        """Return the points that are not too near a place."""
        if self._sensor.min_range <= 0.0:
            return points
        found: Floats = points[np.linalg.norm(points - origin, axis=1) >= self._sensor.min_range]
        return found

    def load(self, codes: Ints64, values: NDArray[np.float32]) -> None:
        """Replace all cells.

        Args:
            codes: Ascending.
            values: Log odds; those out of the limits of the sensor become the nearest ones.
        """
        self.codes = codes
        self.values = np.clip(values, self._least, self._most).astype(np.float32)

    def clear(self, low: Floats, high: Floats) -> None:
        """Set all known cells within a box to surely free [m]."""
        keys = np.stack((low, high)) / self.resolution + ORIGIN
        cells = decode(self.codes)
        inside = (cells >= np.floor(keys[0])).all(axis=1) & (cells <= np.floor(keys[1])).all(axis=1)
        self.values[inside] = self._least

    def forget(self) -> None:
        """Remove all cells."""
        self.codes, self.values = self.codes[:0], self.values[:0]

    def centers(self, chosen: Bools) -> Floats:
        """Return the middles of some cells [m], shape (m, 3)."""
        cells = decode(self.codes[chosen]).astype(np.float64)
        return (cells - ORIGIN + 0.5) * self.resolution

    def isolated(self) -> Bools:
        """Return a mask of occupied cells without an occupied cell among the 26 around them, shape (n,)."""
        occupied = self.occupied
        full = self.codes[occupied]
        keys = decode(full)
        alone = np.ones(len(full), np.bool_)
        for step in np.ndindex(3, 3, 3):
            if step != (1, 1, 1):
                beside = np.clip(keys + np.array(step) - 1, 0, (1 << DEPTH) - 1)
                codes = encode(beside)
                alone &= ~_contains(full, codes) | (codes == full)
        found = np.zeros(len(self.codes), np.bool_)
        found[occupied] = alone
        return found

    def _within_range(self, start: Floats, points: Floats) -> tuple[Floats, Floats]:
        """Return points within the range, and places at the range before the others [cells]."""
        ways = points / self.resolution - start
        away = np.linalg.norm(ways, axis=1)
        most = self._sensor.max_range / self.resolution if self._sensor.max_range >= 0.0 else np.inf
        near = away <= most
        with np.errstate(invalid="ignore"):
            cut = start + ways[~near] * (most / away[~near, None])
        return start + ways[near], cut

    def _ends(self, ends: Floats) -> tuple[Ints64, Floats]:
        """Return the cells of ends within the tree, and an end in each."""
        keys = np.floor(ends).astype(np.int64) + ORIGIN
        inside = ((keys >= 0) & (keys < 1 << DEPTH)).all(axis=1)
        codes, first = np.unique(encode(keys[inside]), return_index=True)
        return codes, ends[inside][first]

    def _update(self, codes: Ints64, change: float) -> None:
        place, known = np.searchsorted(self.codes, codes), _contains(self.codes, codes)
        changed = np.clip(self.values[place[known]] + change, self._least, self._most)
        self.values[place[known]] = changed
        fresh = place[~known]
        self.codes = np.insert(self.codes, fresh, codes[~known])
        self.values = np.insert(self.values, fresh, np.float32(change))


def _contains(codes: Ints64, candidates: Ints64) -> Bools:
    """Return whether ascending codes contain others, shape (candidates,)."""
    place = np.searchsorted(codes, candidates)
    found: Bools = place < len(codes)
    found[found] = codes[place[found]] == candidates[found]
    return found


def _log_odds(probability: float) -> float:
    return math.log(probability / (1.0 - probability))
