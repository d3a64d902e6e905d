"""Convex pieces of a surface merged into larger ones that hold no air.

Bottom up, as Mamou and Ghorbel's "A simple and efficient approach for 3D mesh approximate convex
decomposition" (ICIP 2009). Two pieces that touch become the hull of both, unless it holds a
probe: a place in the air beside the surface. What a hull holds, a larger one holds: a pair that
was refused is never tried again.
"""

from __future__ import annotations

import heapq
from collections.abc import Iterable

import numpy as np

from gazelle.array_types import Floats
from gazelle.geometry.air_probes import AirProbes


class PieceMerger:
    """Pieces, each a convex hull of its points.

    Args:
        clouds: Points of each piece [m], shapes (n, 3).
        probes: Places that no hull of several pieces may hold [m], shape (k, 3).
    """

    def __init__(self, clouds: list[Floats], probes: Floats) -> None:
        self._clouds: dict[int, Floats] = dict(enumerate(clouds))
        self._boxes = {number: _box(cloud) for number, cloud in self._clouds.items()}
        self._next = len(clouds)
        self._probes = AirProbes(probes, sum(map(len, clouds)))
        self._neighbors: dict[int, set[int]] = {}
        self._refused: dict[int, set[int]] = {number: set() for number in self._clouds}

    def merge(self, pairs: Iterable[tuple[int, int]]) -> None:
        """Merge pieces that touch, the smallest first, until no pair is left."""
        self._neighbors = {number: set() for number in self._clouds}
        queue: list[tuple[float, int, int]] = []
        for one, other in pairs:
            self._join(queue, one, other)
        while queue:
            _, one, other = heapq.heappop(queue)
            if one not in self._clouds or other not in self._clouds:
                continue
            cloud = np.concatenate([self._clouds[one], self._clouds[other]])
            corners = self._probes.corners(cloud)
            if corners is None:
                self._refuse(one, other)
            else:
                self._replace(queue, one, other, cloud[corners])

    def clouds(self) -> list[Floats]:
        """Return the points of the pieces that are left."""
        return list(self._clouds.values())

    def overlapping(self) -> list[tuple[int, int]]:
        """Return the pairs of pieces with overlapping boxes that may still be merged."""
        numbers = list(self._clouds)
        low, high = (np.array([self._boxes[number][i] for number in numbers]) for i in (0, 1))
        pairs = []
        for row, number in enumerate(numbers[:-1]):
            near = (low[row + 1 :] <= high[row]).all(axis=1)
            near &= (high[row + 1 :] >= low[row]).all(axis=1)
            others = [numbers[row + 1 + k] for k in np.flatnonzero(near).tolist()]
            pairs += [(number, each) for each in others if each not in self._refused[number]]
        return pairs

    def _join(self, queue: list[tuple[float, int, int]], one: int, other: int) -> None:
        """Queue a pair of neighbours."""
        self._neighbors[one].add(other)
        self._neighbors[other].add(one)
        a, b = self._boxes[one], self._boxes[other]
        x, y, z = (max(a[1][i], b[1][i]) - min(a[0][i], b[0][i]) for i in range(3))
        heapq.heappush(queue, (x * x + y * y + z * z, one, other))

    def _refuse(self, one: int, other: int) -> None:
        self._neighbors[one].discard(other)
        self._neighbors[other].discard(one)
        self._refused[one].add(other)
        self._refused[other].add(one)

    def _replace(
        self, queue: list[tuple[float, int, int]], one: int, other: int, cloud: Floats
    ) -> None:
        """Replace two pieces by one."""
        number = self._next
        self._next += 1
        refused = (self._refused.pop(one) | self._refused.pop(other)) - {one, other}
        near = (self._neighbors.pop(one) | self._neighbors.pop(other)) - {one, other} - refused
        del self._clouds[one], self._clouds[other]
        self._clouds[number], self._neighbors[number] = cloud, set()
        self._boxes[number] = _box(cloud)
        self._refused[number] = {each for each in refused if each in self._clouds}
        for each in self._refused[number]:
            self._refused[each] -= {one, other}
            self._refused[each].add(number)
            self._neighbors[each] -= {one, other}
        for each in near:
            self._neighbors[each] -= {one, other}
            self._join(queue, number, each)


def _box(cloud: Floats) -> tuple[list[float], list[float]]:
    """Return the least and the greatest corner of points."""
    return cloud.min(axis=0).tolist(), cloud.max(axis=0).tolist()
