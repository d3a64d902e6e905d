# cython: infer_types=True, annotation_typing=False
# mypy: disable-error-code="no-any-return"
"""What is asked of a block again and again: how far it reaches, which air it holds, where to cut it.

Every test is made for many directions side by side, and no sum depends on how many there are.
"""

# ruff: noqa: FURB136  # loops that become vectors

from __future__ import annotations

import cython
import numpy as np
from cython.cimports.gazelle.formats.integer_hull import HullBuilder
from cython.cimports.libc.math import fabs

from gazelle.array_types import Bools, Floats, Floats32, Ints32

if not cython.compiled:
    LANES = 16  # in a compiled module, what block_cuts.pxd says

NONE = cython.declare(cython.float, -3e38)


@cython.cclass
class BlockCutter:
    """Asks blocks, one after the other, without the interpreter's lock.

    Args:
        directions: Unit vectors that blocks are measured along, shape (n, 3).
        every: One of so many directions is enough to judge a cut by.
        most: Places by which a cut is judged, at most, of the surface and of the air.
        corners: Of a hull, at most.
    """

    def __init__(self, directions: Floats32, every: int, most: int, corners: int) -> None:
        self.count = len(directions)
        self.around = _padded(directions)
        self.some = _padded(directions[::every])
        width = self.some.shape[1]
        self.of_points = np.zeros((most, width), np.float32)
        self.of_air = np.zeros((most, width), np.float32)
        self.below = np.zeros(width, np.float32)
        self.above = np.zeros(width, np.float32)
        self.builder = HullBuilder(corners)

    def tops(self, points: Floats32) -> tuple[Floats32, Ints32]:
        """How far points reach along each direction [m], and which is the first that does.

        Args:
            points: [m], shape (n, 3), at least one.
        """
        width = self.around.shape[1]
        high, which = np.full(width, NONE, np.float32), np.zeros(width, np.int32)
        places = cython.declare(cython.float[:, ::1], points)
        top = cython.declare(cython.float[::1], high)
        first = cython.declare(cython.int[::1], which)
        with cython.nogil:
            self.reach(places, top, first)
        return high, which[: self.count]

    def behind(self, air: Floats32, tops: Floats32) -> Bools:
        """Which places are no farther than this along any direction, shape (k,).

        Args:
            air: [m], shape (k, 3).
            tops: As ``tops`` gives them [m].
        """
        kept = np.zeros(len(air), np.uint8)
        places = cython.declare(cython.float[:, ::1], air)
        top = cython.declare(cython.float[::1], tops)
        held = cython.declare(cython.uchar[::1], kept)
        with cython.nogil:
            self.keep(places, top, held)
        return kept.view(np.bool_)

    def within(self, hull: Floats, air: Floats32) -> Bools:
        """Which places lie in the hull of points, shape (k,); none if those lie in a plane.

        Args:
            hull: [m], shape (n, 3).
            air: [m], shape (k, 3).
        """
        kept = np.zeros(len(air), np.uint8)
        corners = cython.declare(cython.double[:, ::1], hull)
        places = cython.declare(cython.float[:, ::1], air)
        held = cython.declare(cython.uchar[::1], kept)
        with cython.nogil:
            self.hold(corners, places, held)
        return kept.view(np.bool_)

    def best_cut(
        self, points: Floats32, air: Floats32, axes: Ints32, levels: Floats, uneven: float
    ) -> int:
        """Which cut leaves the least air in the hulls of both halves; -1 if there is none.

        Args:
            points: Of the surface [m], shape (n, 3).
            air: [m], shape (k, 3).
            axes: Across which each cut is, shape (c,).
            levels: Where [m], shape (c,).
            uneven: What it counts that all points are in one half, in places of air.
        """
        on_surface = cython.declare(cython.float[:, ::1], points)
        places = cython.declare(cython.float[:, ::1], air)
        across = cython.declare(cython.int[::1], axes)
        where = cython.declare(cython.double[::1], levels)
        price = cython.declare(cython.double, uneven)
        with cython.nogil:
            found = self.choose(on_surface, places, across, where, price)
        return int(found)

    def reach(self, points: Floats32, top: Floats32, first: Ints32) -> None:
        """``tops`` without Python."""
        width = top.shape[0]
        for i in range(points.shape[0]):
            x, y, z = points[i, 0], points[i, 1], points[i, 2]
            for k in range(width):
                along = x * self.around[0, k] + y * self.around[1, k] + z * self.around[2, k]
                first[k] = i if along > top[k] else first[k]
                top[k] = along if along > top[k] else top[k]

    def keep(self, air: Floats32, top: Floats32, kept: Bools) -> None:
        """``behind`` without Python."""
        width, last = top.shape[0], 0
        for i in range(air.shape[0]):
            x, y, z = air[i, 0], air[i, 1], air[i, 2]
            # Places near each other are mostly told by the same directions.
            if self.beyond(x, y, z, last, top) > 0:
                continue
            begin = 0
            while begin < width and self.beyond(x, y, z, begin, top) == 0:
                begin += LANES
            kept[i] = 1 if begin >= width else 0
            last = begin if begin < width else last

    def beyond(self, x: float, y: float, z: float, begin: int, top: Floats32) -> int:
        """Along how many of some directions a place is too far."""
        count = 0
        for k in range(begin, begin + LANES):
            along = x * self.around[0, k] + y * self.around[1, k] + z * self.around[2, k]
            count += 1 if along > top[k] else 0
        return count

    def hold(self, hull: Floats, air: Floats32, kept: Bools) -> None:
        """``within`` without Python."""
        if not self.builder.build(hull):
            return
        last = -1
        for i in range(air.shape[0]):
            last = self.builder.holds(air[i, 0], air[i, 1], air[i, 2], last)
            kept[i] = 1 if last < 0 else 0

    def choose(
        self, points: Floats32, air: Floats32, axes: Ints32, levels: Floats, uneven: float
    ) -> int:
        """``best_cut`` without Python."""
        count, width, best, least = points.shape[0], self.some.shape[1], -1, 0.0
        self.measure(points, self.of_points)
        self.measure(air, self.of_air)
        for cut in range(axes.shape[0]):
            axis, level, under = axes[cut], levels[cut], 0
            for k in range(width):
                self.below[k] = self.above[k] = NONE
            for i in range(count):
                if points[i, axis] <= level:
                    under += 1
                    for k in range(width):
                        along = self.of_points[i, k]
                        self.below[k] = along if along > self.below[k] else self.below[k]
                else:
                    for k in range(width):
                        along = self.of_points[i, k]
                        self.above[k] = along if along > self.above[k] else self.above[k]
            if under in (0, count):
                continue
            share = cython.cast(cython.double, under) / count - 0.5
            cost = uneven * fabs(share) + self.left(air.shape[0])
            if best < 0 or cost < least:
                best, least = cut, cost
        return best

    def measure(self, places: Floats32, found: Floats32) -> None:
        """Where places are along the directions that cuts are judged by."""
        for i in range(places.shape[0]):
            x, y, z = places[i, 0], places[i, 1], places[i, 2]
            for k in range(self.some.shape[1]):
                found[i, k] = x * self.some[0, k] + y * self.some[1, k] + z * self.some[2, k]

    def left(self, count: int) -> int:
        """How many places of air are in one half or the other."""
        held = 0
        for i in range(count):
            over, under = 0, 0
            for k in range(self.some.shape[1]):
                over += 1 if self.of_air[i, k] > self.below[k] else 0
                under += 1 if self.of_air[i, k] > self.above[k] else 0
            held += 1 if over == 0 or under == 0 else 0
        return held


def _padded(directions: Floats32) -> Floats32:
    """Directions as three rows, with the first repeated until whole vectors are full."""
    lacking = LANES - 1 - (len(directions) - 1) % LANES
    every = np.concatenate([directions, directions[:1].repeat(lacking, axis=0)])
    return np.ascontiguousarray(every.T, np.float32)
