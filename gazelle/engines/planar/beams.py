# cython: infer_types=True, annotation_typing=False
"""The beams of a fan, and primitives drawn into them: a depth buffer with one row.

Everything is in the frame of the sensor. One over a distance is kept instead of the distance
because the distance to a line, 1 / (a dx - b dy), then needs no division. Only beams within the
angles that a primitive covers are tested. Distances are exact; angles only choose which beams are
certainly missed.
"""

# ruff: noqa: FBT001, FURB136  # arguments in order; loops that become vectors

from __future__ import annotations

import cython
import numpy as np
from cython.cimports.gazelle.engines.planar.scan_columns import (
    C_FIRST,
    C_INVERSE,
    C_NAME,
    C_RADIUS,
    C_SPAN,
    C_X0,
    C_X1,
    C_Y0,
    C_Y1,
    ROOM,
)  # fmt: skip
from cython.cimports.libc.math import ceil, fabs, floor, sqrt

from gazelle.array_types import Floats

INF = cython.declare(cython.double, float("inf"))
PI = cython.declare(cython.double, 3.141592653589793)
TURN = cython.declare(cython.double, 6.283185307179586)
if not cython.compiled:
    WIDE = 16  # in a compiled module, what beams.pxd says
FEW = cython.declare(cython.int, 48)  # beams from which it pays to find out which ones are missed


def angle_of(y: float, x: float) -> float:
    """Return atan2 to 1e-5 rad.

    See Abramowitz and Stegun, Handbook of Mathematical Functions, 4.4.47.
    """
    ax, ay = fabs(x), fabs(y)
    low, high = (ax if ax < ay else ay), (ay if ax < ay else ax)
    q = low / (high if high > 1e-300 else 1e-300)
    s = q * q
    a = q * (0.9998660 + s * (-0.3302995 + s * (0.1801410 + s * (-0.0851330 + s * 0.0208351))))
    a = 0.5 * PI - a if ay > ax else a
    a = PI - a if x < 0.0 else a
    angle: float = -a if y < 0.0 else a
    return angle


class Beams:
    """Beams from one point at equal angles, and the nearest that each has met.

    Args:
        angles: Of the beams from the sensor's x axis [rad], shape (count,).
        step: Between two of them [rad].
        reach: Their range [m].
        begin: Smallest distance of hits [m].
        slack: Largest error of angles that choose beams [rad].

    Attributes:
        dx: Their directions.
        dy: Their directions.
        best: One over the distance to the nearest primitive met so far [1/m].
        who: Name of that primitive, see ``columns.NAMES``.
    """

    def __init__(
        self, angles: Floats, step: float, reach: float, begin: float, slack: float
    ) -> None:
        self.count = len(angles)
        self.start, self.rate, self.reach, self.slack = angles[0], 1.0 / step, reach, slack
        self.near = 1.0 / begin if begin > 0.0 else INF
        self.dx, self.dy = np.cos(angles), np.sin(angles)
        self.best, self.who = np.zeros(self.count), np.zeros(self.count)

    def clear(self) -> None:
        """Clear the hits of beams."""
        nothing = 1.0 / self.reach
        for k in range(self.count):
            self.best[k] = nothing
            self.who[k] = 0.0

    def draw_segment(
        self, lo: int, hi: int, x0: float, y0: float, x1: float, y1: float, inverse: float,
        name: float,
    ) -> None:  # fmt: skip
        """Draw a segment, which may be missed on either side, into beams lo to hi."""
        near = self.near
        for k in range(lo, hi):
            dx, dy, best, who = self.dx[k], self.dy[k], self.best[k], self.who[k]
            c0 = dx * y0 - dy * x0
            c1 = dx * y1 - dy * x1
            v = (c1 - c0) * inverse
            met = (c0 * c1 <= 0.0) & (v > best) & (v <= near)
            self.best[k] = v if met else best
            self.who[k] = name if met else who

    def draw_circle(
        self, lo: int, hi: int, x: float, y: float, square: float, inverse: float, name: float
    ) -> None:
        """Draw a circle, which may be missed, into beams lo to hi.

        Hits from inside are negative.
        """
        near = self.near
        for k in range(lo, hi):
            dx, dy, best, who = self.dx[k], self.dy[k], self.best[k], self.who[k]
            along = dx * x + dy * y
            aside = dx * y - dy * x
            rest = square - aside * aside
            root = sqrt(rest if rest > 0.0 else 0.0)
            front = (along + root) * inverse
            facing = (front > 0.0) & (front <= near)
            side = 1.0 if facing else -1.0
            v = (along + side * root) * inverse
            met = (rest >= 0.0) & (v > best) & (v <= near)
            self.best[k] = v if met else best
            self.who[k] = side * name if met else who

    def draw_front(
        self, lo: int, hi: int, x0: float, y0: float, x1: float, y1: float, inverse: float
    ) -> None:
        """Draw a segment into beams lo to hi, whatever its distance and name."""
        for k in range(lo, hi):
            dx, dy, best = self.dx[k], self.dy[k], self.best[k]
            c0 = dx * y0 - dy * x0
            c1 = dx * y1 - dy * x1
            v = (c1 - c0) * inverse
            met = (c0 * c1 <= 0.0) & (v > best)
            self.best[k] = v if met else best

    def draw_two(
        self, ax: float, ay: float, bx: float, by: float, i: float, cx: float, cy: float,
        dx: float, dy: float, j: float,
    ) -> None:  # fmt: skip
        """Draw two segments into all beams, as ``draw_front`` does with one."""
        for k in range(self.count):
            x, y, best = self.dx[k], self.dy[k], self.best[k]
            c0 = x * ay - y * ax
            c1 = x * by - y * bx
            v = (c1 - c0) * i
            met = (c0 * c1 <= 0.0) & (v > best)
            best = v if met else best
            c0 = x * cy - y * cx
            c1 = x * dy - y * dx
            v = (c1 - c0) * j
            met = (c0 * c1 <= 0.0) & (v > best)
            self.best[k] = v if met else best

    def draw_disc(
        self, lo: int, hi: int, x: float, y: float, radius: float, inverse: float
    ) -> None:
        """Draw a disc that beams lo to hi begin outside of, whatever its distance and name."""
        square = radius * radius
        for k in range(lo, hi):
            dx, dy, best = self.dx[k], self.dy[k], self.best[k]
            along = dx * x + dy * y
            aside = dx * y - dy * x
            rest = square - aside * aside
            root = sqrt(rest if rest > 0.0 else 0.0)
            v = (along + root) * inverse
            met = (rest >= 0.0) & (along > 0.0) & (v > best)
            self.best[k] = v if met else best

    def between(self, first: float, span: float, turn: int) -> tuple[int, int]:
        """Return the range of beams within an interval of angles that ``cover`` found.

        Args:
            first: Lower end of the interval [rad].
            span: Length of the interval [rad].
            turn: Full turns to add to it. Callers try 0 and -1, as a fan may span a full turn.
        """
        first += TURN * turn
        lo = ceil(first * self.rate)
        hi = floor((first + span) * self.rate) + 1.0
        count = cython.cast(cython.double, self.count)
        if hi <= 0.0 or lo >= count:
            return 0, 0
        return (
            cython.cast(cython.Py_ssize_t, max(lo, 0.0)),
            cython.cast(cython.Py_ssize_t, min(hi, count)),
        )

    def hidden(self, lo: int, hi: int, inverse: float) -> bool:
        """Return whether beams lo to hi all meet something nearer than one over ``inverse``."""
        for k in range(lo, hi):  # noqa: SIM110  # kernels know no generators
            if self.best[k] < inverse:
                return False
        return True

    def too_near(self) -> bool:
        """Return whether a beam met something nearer than where beams begin."""
        nearer = 0  # counted, as sums of ints become vectors, and a maximum does not
        for k in range(self.count):
            nearer += self.best[k] > self.near
        return nearer > 0

    def farthest(self) -> float:
        """Return the length of the longest beam [m]."""
        least = cython.declare(cython.double[WIDE])
        for j in range(WIDE):
            least[j] = INF
        whole = self.count - self.count % WIDE
        k = 0
        while k < whole:
            for j in range(WIDE):
                best = self.best[k + j]
                least[j] = best if best < least[j] else least[j]
            k += WIDE
        nearest = INF
        for j in range(WIDE):
            nearest = min(nearest, least[j])
        while k < self.count:
            nearest = min(nearest, self.best[k])
            k += 1
        far: float = 1.0 / nearest
        return far

    def report(
        self,
        m: int,
        missing: float,
        signed: bool,
        ranges: Floats,
        names: Floats,
    ) -> None:
        """Write down what the beams of sensor m met.

        Args:
            m: Row of ``ranges`` and ``names``.
            missing: Range of a beam that met nothing [m].
            signed: Whether what is met from inside is minus infinity.
            ranges: Comes out.
            names: Comes out, if it has rows.
        """
        nothing = 1.0 / self.reach
        for k in range(self.count):
            best = self.best[k]
            t = 1.0 / best
            ranges[m, k] = t if best > nothing else missing
        if signed:
            for k in range(self.count):
                if self.who[k] < 0.0:
                    ranges[m, k] = -INF
        if names.shape[0] > 0:
            for k in range(self.count):
                names[m, k] = self.who[k]


class Candidates:
    """Segments, discs and bodies that a sensor may see, in its frame.

    Attributes:
        table: Columns as ``columns.C_X0`` and what follows say, shape (11 * ROOM,).
    """

    def __init__(self) -> None:
        self.table = np.zeros(11 * ROOM)

    def solve(self, n: int) -> None:
        """Prepare the first n for drawing: what distances are shares of, and names by side.

        A segment is solid on its left: a viewpoint there is inside.
        """
        for i in range(n):
            x0, y0, x1, y1 = (
                self.table[C_X0 + i],
                self.table[C_Y0 + i],
                self.table[C_X1 + i],
                self.table[C_Y1 + i],
            )
            radius, name = self.table[C_RADIUS + i], self.table[C_NAME + i]
            circle, line = x0 * x0 + y0 * y0 - radius * radius, x0 * y1 - x1 * y0
            cross = circle if radius > 0.0 else line
            self.table[C_INVERSE + i] = 0.0 if cross == 0.0 else 1.0 / cross
            inside = (radius <= 0.0) & (cross >= 0.0)
            self.table[C_NAME + i] = -name if inside else name

    def cover(self, n: int, beams: Beams) -> None:
        """Find the angles that the first n cover, less what they may be wrong by."""
        start, slack = beams.start + beams.slack, 2.0 * beams.slack
        for i in range(n):
            x0, y0, x1, y1 = (
                self.table[C_X0 + i],
                self.table[C_Y0 + i],
                self.table[C_X1 + i],
                self.table[C_Y1 + i],
            )
            radius = self.table[C_RADIUS + i]
            outside = x0 * x0 + y0 * y0 - radius * radius
            half = angle_of(radius, sqrt(outside if outside > 1e-300 else 1e-300))
            a, b = angle_of(y0, x0), angle_of(y1, x1)
            left = x0 * y1 - x1 * y0 > 0.0
            begin, end = (a if left else b), (b if left else a)
            span = end - begin
            span = (span + TURN if span < 0.0 else span) + 2.0 * half
            inside = (radius > 0.0) & (outside <= 0.0)
            begin -= half
            begin -= start
            self.table[C_FIRST + i] = begin - TURN * floor(begin / TURN)
            self.table[C_SPAN + i] = (TURN if inside else span) + slack

    def draw_one(self, i: int, lo: int, hi: int, beams: Beams) -> None:
        """Draw the i-th, solved, into beams lo to hi."""
        radius, inverse, name = (
            self.table[C_RADIUS + i],
            self.table[C_INVERSE + i],
            self.table[C_NAME + i],
        )
        if radius > 0.0:
            square = radius * radius
            beams.draw_circle(
                lo, hi, self.table[C_X0 + i], self.table[C_Y0 + i], square, inverse, name
            )
        else:
            beams.draw_segment(
                lo,
                hi,
                self.table[C_X0 + i],
                self.table[C_Y0 + i],
                self.table[C_X1 + i],
                self.table[C_Y1 + i],
                inverse,
                name,
            )

    def draw(self, n: int, beams: Beams) -> None:
        """Draw the first n, solved."""
        count = beams.count
        if count <= FEW:
            for i in range(n):
                self.draw_one(i, 0, count, beams)
            return
        self.cover(n, beams)
        for i in range(n):
            for turn in range(2):
                lo, hi = beams.between(self.table[C_FIRST + i], self.table[C_SPAN + i], -turn)
                if lo < hi:
                    self.draw_one(i, lo, hi, beams)

    def solve_and_draw(self, n: int, beams: Beams) -> None:
        """Draw the first n."""
        self.solve(n)
        self.draw(n, beams)
