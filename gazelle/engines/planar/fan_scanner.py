# cython: infer_types=True, annotation_typing=False
# mypy: disable-error-code="misc, name-defined"
"""Scan with the same fan on some bodies of all worlds, in the way that is fastest there."""

# ruff: noqa: F821  # locks are names of the .pxd

from __future__ import annotations

from typing import Any

import cython
import numpy as np
from cython.cimports.gazelle.engines.planar.beams import Beams, Candidates
from cython.cimports.gazelle.engines.planar.near_bodies import meet_bodies
from cython.cimports.gazelle.engines.planar.scan_columns import (
    ANGLE_NOISE,
    CROWDED,
    LANE_BEST,
    LANE_NAME,
    MOST_LANES,
    SINGLY,
)  # fmt: skip
from cython.cimports.gazelle.engines.planar.viewpoint import Viewpoint
from cython.cimports.gazelle.native.elementary import cos, sin
from cython.cimports.gazelle.native.hashed_noise import normal, stream
from cython.cimports.gazelle.native.system import System
from numpy.typing import NDArray

from gazelle.array_types import Floats

MANY = cython.declare(cython.int, 256)  # statics in view from which hidden ones are looked for
PLACES = cython.declare(cython.longlong, 1 << 40)  # of numbers for angles, after those of ranges


class FanScanner(System):
    """The same fan on some bodies, and what one thread needs to scan with it.

    Args:
        beams: Of the fan; written on.
        at: Origins of scans; overwritten.
        lanes: Beams on their way; None where all is drawn.
        front: Faces towards the sensors; None where scenes are large or names wanted.
        mounts: Places on bodies, as ``columns.S_X`` and what follows say, shape (n, SENSOR).
        middles: Directions of the middles of bundles of beams, shape (2, n).

    Attributes:
        next: The same scanner for one thread more; it shares all results.
        owners: Body of each sensor, counted through all worlds.
        ranges: Comes out [m], a row a sensor.
        names: Hit of each beam, as ``columns.NAMES`` says, a row a sensor; no rows if that is
            not wanted.
        missing: Range of beams that meet nothing [m].
        signed: Whether what is met from inside has the range minus infinity.
        way: See ``scan_columns.ALL`` and what follows.
        spread: Standard deviation of the angles of beam errors [rad], one a mount.
        step: Angle between two beams [rad].
        constant: Standard deviation of normal noise on ranges [m].
        share: The same, as a share of the range.
        seed: Of noise.
    """

    def __cinit__(self) -> None:
        self.lock = PyThread_allocate_lock()

    def __dealloc__(self) -> None:
        if self.lock != cython.NULL:
            PyThread_free_lock(self.lock)

    def __init__(
        self,
        beams: Beams,
        at: Viewpoint,
        lanes: Any,
        front: Any,
        mounts: Floats,
        middles: Floats,
    ) -> None:
        System.__init__(self, max(1, len(mounts)))
        self.beams, self.at, self.bodies, self.lanes = beams, at, at.bodies, lanes
        self.front, self.mounts, self.middles = front, mounts, middles
        self.next: Any = None
        self.way, self.step, self.missing, self.signed = 0, 1.0, beams.reach, False
        self.constant, self.share, self.seed = 0.0, 0.0, 0
        self.spread = np.zeros(len(mounts))
        self.owners = np.zeros(0, np.int64)
        self.ranges = self.names = np.zeros((0, beams.count))
        self.found, self.begins = Candidates(), np.zeros(middles.shape[1])

    def scan(self, owners: NDArray[np.int64], first: int, last: int, tick: int, part: int) -> None:
        """Scan with the sensors first to last, without the interpreter's lock.

        Args:
            owners: Their bodies, counted through all worlds.
            first: Of them.
            last: Before it.
            tick: Of noise.
            part: Number of the thread; each has its own.
        """
        rows = cython.declare(cython.longlong[::1], owners)
        begin, end = (
            cython.declare(cython.Py_ssize_t, first),
            cython.declare(cython.Py_ssize_t, last),
        )
        when, which = cython.declare(cython.longlong, tick), cython.declare(cython.Py_ssize_t, part)
        with cython.nogil:
            self.work(rows, begin, end, when, which)

    def update(self, first: int, last: int, time: int) -> None:
        """Scan with the sensors first to last; any number of threads may, each with its own.

        ``time`` counts scans: noise depends on it.
        """
        if not cython.compiled:
            self.work(self.owners, first, last, time, 0)
        elif PyThread_acquire_lock(self.lock, 0):  # of the .pxd
            self.work(self.owners, first, last, time, 0)
            PyThread_release_lock(self.lock)
        elif self.next is not None:
            self.next.update(first, last, time)
        else:
            PyThread_acquire_lock(self.lock, 1)
            PyThread_release_lock(self.lock)
            self.update(first, last, time)

    def work(self, owners: NDArray[np.int64], first: int, last: int, tick: int, part: int) -> None:
        """Scan with some sensors; see ``scan``."""
        if part > 0:
            self.next.work(owners, first, last, tick, part - 1)
            return
        if self.way == CROWDED:
            self.scan_crowded(owners, first, last)
        elif self.way == SINGLY:
            self.scan_singly(owners, first, last)
        elif self.way == ANGLE_NOISE:
            self.scan_with_angle_noise(owners, first, last, tick)
        else:
            self.scan_all(owners, first, last)
        if self.constant > 0.0 or self.share > 0.0:
            self.blur(owners, first, last, tick)

    def scan_all(self, owners: NDArray[np.int64], first: int, last: int) -> None:
        """Draw everything in view."""
        for m in range(first, last):
            self.at.aim(self.mounts, m, owners[m])
            if self.front is not None and self.front.look(self.at, self.beams):
                self.beams.report(m, self.missing, False, self.ranges, self.names)
            else:
                self.scan_one(m)

    def scan_one(self, m: int) -> None:
        """Scan with sensor m, which is aimed, whatever is there."""
        self.beams.clear()
        if self.bodies.grid[3] * self.bodies.grid[4] > 1.0:
            self.at.put_view(1.0)
        self.at.draw(False)
        self.beams.report(m, self.missing, self.signed, self.ranges, self.names)

    def scan_crowded(self, owners: NDArray[np.int64], first: int, last: int) -> None:
        """Cast beams where many statics are in view, without a look at hidden ones."""
        for m in range(first, last):
            self.at.aim(self.mounts, m, owners[m])
            self.beams.clear()
            self.at.put_view(1.0)
            crowded = self.lanes.space.is_clear(self.at.z) and self.at.is_crowded(MANY)
            if crowded:
                self.lanes.meet_ahead(
                    self.beams, self.middles[0], self.middles[1], self.begins, self.at
                )
                self.at.put_view(self.beams.farthest() / self.beams.reach)
            self.at.draw(crowded)
            self.beams.report(m, self.missing, self.signed, self.ranges, self.names)

    def scan_singly(self, owners: NDArray[np.int64], first: int, last: int) -> None:
        """Cast the beams of many sensors side by side, as fans of few have them."""
        count, begin = self.beams.count, first
        while begin < last:
            end = end_of(owners, begin, last, MOST_LANES // count)
            for m in range(begin, end):
                self.at.aim(self.mounts, m, owners[m])
                self.lanes.put(
                    (m - begin) * count, self.beams.dx, self.beams.dy, 0, count, self.at,
                    self.beams.reach,
                )  # fmt: skip
            self.lanes.meet_statics((end - begin) * count)
            m = begin
            while m < end:
                same = m + 1
                while same < end and owners[same] == owners[m]:
                    same += 1
                meet_bodies(
                    self.lanes, (m - begin) * count, (same - begin) * count, self.found, owners[m]
                )
                m = same
            for m in range(begin, end):
                self.at.aim(self.mounts, m, owners[m])
                if self.lanes.space.is_clear(self.at.z):
                    self.lanes.report(
                        (m - begin) * count, count, m, self.beams.reach, self.missing, self.signed,
                        self.ranges, self.names,
                    )  # fmt: skip
                else:
                    self.scan_one(m)
            begin = end

    def scan_with_angle_noise(
        self, owners: NDArray[np.int64], first: int, last: int, tick: int
    ) -> None:
        """Scan with normal noise on the angle of every beam."""
        total = self.beams.count
        for m in range(first, last):
            self.at.aim(self.mounts, m, owners[m])
            mount = m % self.mounts.shape[0]
            random = stream(self.seed, owners[m], tick)
            base = 0
            while base < total:
                count = min(MOST_LANES, total - base)
                for k in range(base, base + count):
                    wave = normal(random, PLACES + 2 * (mount * total + k))
                    angle = self.beams.start + k * self.step + self.spread[mount] * wave
                    self.beams.dx[k], self.beams.dy[k] = cos(angle), sin(angle)
                self.lanes.put(
                    0, self.beams.dx, self.beams.dy, base, count, self.at, self.beams.reach
                )
                self.lanes.meet_statics(count)
                meet_bodies(self.lanes, 0, count, self.found, owners[m])
                for k in range(count):
                    self.beams.best[base + k] = self.lanes.table[LANE_BEST + k]
                    self.beams.who[base + k] = self.lanes.table[LANE_NAME + k]
                base += count
            self.beams.report(m, self.missing, self.signed, self.ranges, self.names)

    def blur(self, owners: NDArray[np.int64], first: int, last: int, tick: int) -> None:
        """Add normal noise to ranges, but to those that met nothing.

        What is left stays within 0 and the reach.
        """
        reach = self.beams.reach
        for m in range(first, last):
            start = stream(self.seed, owners[m], tick)
            for k in range(self.beams.count):
                true = self.ranges[m, k]
                if true >= reach:
                    continue
                noisy = true + (self.constant + self.share * true) * normal(start, 2 * k)
                self.ranges[m, k] = min(max(noisy, 0.0), reach)


def end_of(owners: NDArray[np.int64], first: int, last: int, most: int) -> int:
    """Return the end of a run of sensors: ``most`` at most, a body's together if possible."""
    end = min(last, first + most)
    if end < last:
        whole = end
        while whole > first and owners[whole] == owners[whole - 1]:
            whole -= 1
        end = whole if whole > first else end
    return end
