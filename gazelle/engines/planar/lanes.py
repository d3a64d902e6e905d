# cython: infer_types=True, annotation_typing=False
"""Beams that cross empty space in long strides, many of them side by side.

A lane is a beam on its way. Strides end a little beyond the edges of cells, so that they never
stand still; primitives are listed in cells by a margin that is larger.
"""

# ruff: noqa: FBT001  # arguments in order; loops that become vectors

from __future__ import annotations

import cython
import numpy as np
from cython.cimports.gazelle.engines.planar.beams import Beams
from cython.cimports.gazelle.engines.planar.bodies import Bodies
from cython.cimports.gazelle.engines.planar.clear_space import ClearSpace
from cython.cimports.gazelle.engines.planar.columns import (
    CIRCLE,
    COS,
    FIRST_VISUAL,
    GLOW,
    HIGH,
    KIND,
    LAST_VISUAL,
    LOW,
    NAMES,
    SIN,
    X0,
    X1,
    Y0,
    Y1,
    X,
    Y,
    Z,
)  # fmt: skip
from cython.cimports.gazelle.engines.planar.scan_columns import (
    COLUMNS,
    CORNER_U,
    CORNER_V,
    LANE_AT,
    LANE_AT_U,
    LANE_AT_V,
    LANE_BASE,
    LANE_BEST,
    LANE_DU,
    LANE_DV,
    LANE_DX,
    LANE_DY,
    LANE_END,
    LANE_FREE,
    LANE_HEIGHT,
    LANE_NAME,
    LANE_OUT,
    LANE_OVER_U,
    LANE_OVER_V,
    LANE_U,
    LANE_V,
    LANE_X,
    LANE_Y,
    MOST_LANES,
    ROWS,
    SIDE_U,
    SIDE_V,
    SOLID_NAME,
    TURN_COS,
    TURN_SIN,
)  # fmt: skip
from cython.cimports.gazelle.engines.planar.viewpoint import Viewpoint
from cython.cimports.gazelle.native.elementary import cos as cosine
from cython.cimports.gazelle.native.elementary import sin as sine
from cython.cimports.libc.math import fabs, floor, sqrt

from gazelle.array_types import Floats

INF = cython.declare(cython.double, float("inf"))
SIDE_BY_SIDE = cython.declare(cython.int, 32)  # beams of a bundle
NARROW = cython.declare(cython.double, 0.2)  # of bundles [rad]
NUDGE = cython.declare(cython.double, 1e-9)  # by which strides go beyond the edge of a cell [m]
LISTED = cython.declare(cython.double, 1e-6)  # by which statics are in cells they do not pass [m]
LEVEL = cython.declare(cython.double, 1e-12)  # directions along an axis that are less are this


class Lanes:
    """Some beams on their way.

    Args:
        space: Space without static parts.
        bodies: All that there is.
        begin: Smallest distance of hits [m].
    """

    def __init__(self, space: ClearSpace, bodies: Bodies, begin: float) -> None:
        self.space, self.bodies, self.fine = space, bodies, space.fine
        self.near = 1.0 / begin if begin > 0.0 else INF
        self.table = np.zeros(20 * MOST_LANES)

    def put(
        self, first: int, dx: Floats, dy: Floats, base: int, count: int, at: Viewpoint,
        reach: float,
    ) -> None:  # fmt: skip
        """Start beams, from number ``base`` on, as lanes from ``first`` on."""
        x, y, c, s, height = at.x, at.y, at.cos, at.sin, at.z
        cos, sin = self.fine[TURN_COS], self.fine[TURN_SIN]
        side_u, side_v = self.fine[SIDE_U], self.fine[SIDE_V]
        columns, rows = self.fine[COLUMNS], self.fine[ROWS]
        u = (cos * x + sin * y - self.fine[CORNER_U]) / side_u
        v = (cos * y - sin * x - self.fine[CORNER_V]) / side_v
        for k in range(count):
            i = first + k
            bx, by = dx[base + k], dy[base + k]
            ex, ey = c * bx - s * by, s * bx + c * by
            self.table[LANE_X + i], self.table[LANE_Y + i] = x, y
            self.table[LANE_DX + i], self.table[LANE_DY + i] = ex, ey
            along, across = cos * ex + sin * ey, cos * ey - sin * ex
            along = LEVEL if fabs(along) < LEVEL else along
            across = LEVEL if fabs(across) < LEVEL else across
            over_u, over_v = side_u / along, side_v / across
            au, bu = -u * over_u, (columns - u) * over_u
            av, bv = -v * over_v, (rows - v) * over_v
            self.table[LANE_U + i], self.table[LANE_V + i] = u, v
            self.table[LANE_DU + i], self.table[LANE_DV + i] = along / side_u, across / side_v
            self.table[LANE_OVER_U + i], self.table[LANE_OVER_V + i] = over_u, over_v
            self.table[LANE_AT + i] = max(0.0, max(min(au, bu), min(av, bv)) - LISTED)
            self.table[LANE_OUT + i] = min(reach, min(max(au, bu), max(av, bv)) + LISTED)
            self.table[LANE_BEST + i], self.table[LANE_NAME + i] = 1.0 / reach, 0.0
            self.table[LANE_HEIGHT + i] = height
            quadrant = (0.0 if along > 0.0 else 2.0) + (0.0 if across > 0.0 else 1.0)
            self.table[LANE_BASE + i] = quadrant * columns * rows

    # -- advancing ----------------------------------------------------------------------

    def cell_of(self, i: int, columns: float, rows: float) -> tuple[float, float]:
        """Return column and row of the cell that lane i is in."""
        at = self.table[LANE_AT + i]
        u = floor(self.table[LANE_U + i] + at * self.table[LANE_DU + i])
        v = floor(self.table[LANE_V + i] + at * self.table[LANE_DV + i])
        return min(max(u, 0.0), columns - 1.0), min(max(v, 0.0), rows - 1.0)

    def beyond(self, i: int, u: float, v: float, wide: float) -> float:
        """Return how far lane i is when it leaves the square of cells around (u, v)."""
        to_u = u + wide if self.table[LANE_DU + i] > 0.0 else u + 1.0 - wide
        to_v = v + wide if self.table[LANE_DV + i] > 0.0 else v + 1.0 - wide
        edge = min(
            (to_u - self.table[LANE_U + i]) * self.table[LANE_OVER_U + i],
            (to_v - self.table[LANE_V + i]) * self.table[LANE_OVER_V + i],
        )
        after: float = max(self.table[LANE_AT + i], edge) + NUDGE
        return after

    def look_around(self, count: int) -> None:
        """Find where lanes are, and how much is clear there."""
        columns, rows = self.fine[COLUMNS], self.fine[ROWS]
        for i in range(count):
            u, v = self.cell_of(i, columns, rows)
            self.table[LANE_AT_U + i], self.table[LANE_AT_V + i] = u, v
        for i in range(count):
            cell = cython.cast(
                cython.Py_ssize_t,
                self.table[LANE_BASE + i]
                + self.table[LANE_AT_V + i] * columns
                + self.table[LANE_AT_U + i],
            )
            self.table[LANE_FREE + i] = self.space.clear[cell]

    def march(self, count: int) -> None:
        """Advance lanes until each is at its end or at an occupied cell."""
        moving = 1
        while moving > 0:
            moving = 0
            self.look_around(count)
            for i in range(count):
                free, at = self.table[LANE_FREE + i], self.table[LANE_AT + i]
                after = self.beyond(i, self.table[LANE_AT_U + i], self.table[LANE_AT_V + i], free)
                go = (free > 0.0) & (at < self.table[LANE_END + i])
                self.table[LANE_AT + i] = after if go else at
                moving += go

    def march_bundles(self, count: int, spread: float) -> None:
        """Advance lanes as far as all beams beside them can follow.

        Args:
            count: Number of lanes, each the middle of a bundle.
            spread: Lateral offset of beams, as a share of the distance.
        """
        least = min(self.fine[SIDE_U], self.fine[SIDE_V])
        moving = 1
        while moving > 0:
            moving = 0
            self.look_around(count)
            for i in range(count):
                at = self.table[LANE_AT + i]
                way = (self.table[LANE_FREE + i] - 1.0) * least - at * spread
                way = way / (1.0 + spread) - LISTED
                go = (way > 0.5 * least) & (at < self.table[LANE_END + i])
                self.table[LANE_AT + i] = at + way if go else at
                moving += go

    # -- meeting -----------------------------------------------------------------------

    def meet_segment(self, i: int, c0: float, c1: float, cross: float, name: float) -> None:
        """Intersect lane i with a segment whose ends are c0 and c1 aside of it."""
        if c0 * c1 <= 0.0 and cross != 0.0:
            v = (c1 - c0) / cross
            if v > self.table[LANE_BEST + i] and v <= self.near:
                self.table[LANE_BEST + i] = v
                self.table[LANE_NAME + i] = name if cross < 0.0 else -name

    def meet_disc(
        self, i: int, dx: float, dy: float, x: float, y: float, radius: float, name: float
    ) -> None:
        """Intersect lane i with a circle about a point seen from it.

        The lane's direction is (dx, dy).
        """
        along, aside = dx * x + dy * y, dx * y - dy * x
        rest, cross = radius * radius - aside * aside, x * x + y * y - radius * radius
        if rest >= 0.0 and cross != 0.0:
            root = sqrt(rest)
            front, back = (along + root) / cross, (along - root) / cross
            facing = front > 0.0 and front <= self.near
            v = front if facing else back
            if v > self.table[LANE_BEST + i] and v <= self.near:
                self.table[LANE_BEST + i] = v
                self.table[LANE_NAME + i] = name if facing else -name

    def meet_static(self, i: int, p: int) -> None:
        """Intersect lane i with a static primitive; hits from inside have a negative name."""
        height = self.table[LANE_HEIGHT + i]
        if (
            self.bodies.statics[p, GLOW] < 0.0
            or height < self.bodies.statics[p, LOW]
            or height > self.bodies.statics[p, HIGH]
        ):
            return
        x, y = self.table[LANE_X + i], self.table[LANE_Y + i]
        dx, dy = self.table[LANE_DX + i], self.table[LANE_DY + i]
        x0, y0 = self.bodies.statics[p, X0] - x, self.bodies.statics[p, Y0] - y
        if (
            cython.cast(cython.int, self.bodies.statics[p, KIND]) & cython.cast(cython.int, CIRCLE)
        ) != 0:
            self.meet_disc(i, dx, dy, x0, y0, self.bodies.statics[p, X1], p + 1.0)
            return
        x1, y1 = self.bodies.statics[p, X1] - x, self.bodies.statics[p, Y1] - y
        c0, c1 = dx * y0 - dy * x0, dx * y1 - dy * x1
        self.meet_segment(i, c0, c1, x0 * y1 - x1 * y0, p + 1.0)

    def meet_body(self, i: int, k: int, b: int) -> None:
        """Intersect lane i with body b, of kind k."""
        c, s = self.bodies.rows[b, COS], self.bodies.rows[b, SIN]
        ox = self.table[LANE_X + i] - self.bodies.rows[b, X]
        oy = self.table[LANE_Y + i] - self.bodies.rows[b, Y]
        x, y = c * ox + s * oy, c * oy - s * ox
        ex, ey = self.table[LANE_DX + i], self.table[LANE_DY + i]
        dx, dy = c * ex + s * ey, c * ey - s * ex
        height = self.table[LANE_HEIGHT + i] - self.bodies.rows[b, Z]
        first = cython.cast(cython.Py_ssize_t, self.bodies.kinds[k, FIRST_VISUAL])
        last = cython.cast(cython.Py_ssize_t, self.bodies.kinds[k, LAST_VISUAL])
        for p in range(first, last):
            if (
                self.bodies.visuals[p, GLOW] < 0.0
                or height < self.bodies.visuals[p, LOW]
                or height > self.bodies.visuals[p, HIGH]
            ):
                continue
            name = NAMES * (b + 1.0) + p
            x0, y0 = self.bodies.visuals[p, X0] - x, self.bodies.visuals[p, Y0] - y
            if (
                cython.cast(cython.int, self.bodies.visuals[p, KIND])
                & cython.cast(cython.int, CIRCLE)
            ) != 0:
                self.meet_disc(i, dx, dy, x0, y0, self.bodies.visuals[p, X1], name)
            else:
                x1, y1 = self.bodies.visuals[p, X1] - x, self.bodies.visuals[p, Y1] - y
                c0, c1 = dx * y0 - dy * x0, dx * y1 - dy * x1
                self.meet_segment(i, c0, c1, x0 * y1 - x1 * y0, name)

    def meet_statics(self, count: int) -> None:
        """Advance lanes until each has met the nearest static primitive, or is at its end."""
        for i in range(count):
            self.table[LANE_END + i] = self.table[LANE_OUT + i]
        self.march(count)
        columns, rows = self.fine[COLUMNS], self.fine[ROWS]
        for i in range(count):
            end = self.table[LANE_END + i]
            begun = self.table[LANE_AT + i] > 0.0
            solid = False  # whether it is in what it began in
            while self.table[LANE_AT + i] < end:
                u, v = self.cell_of(i, columns, rows)
                cell = cython.cast(cython.Py_ssize_t, v * columns + u)
                base = cython.cast(cython.Py_ssize_t, self.table[LANE_BASE + i])
                wide = cython.cast(cython.double, self.space.clear[base + cell])
                way = self.table[LANE_AT + i] - NUDGE
                if not begun or way <= NUDGE:  # on an edge it may seem to be on either side
                    begun, solid = True, wide < 0.0
                elif (wide < 0.0) != solid:
                    met = 1.0 / way
                    if met > self.table[LANE_BEST + i]:
                        self.table[LANE_BEST + i] = met
                        name = self.fine[SOLID_NAME]
                        self.table[LANE_NAME + i] = -name if solid else name
                    break
                if wide <= 0.0:
                    for j in range(self.space.start[cell], self.space.start[cell + 1]):
                        self.meet_static(i, self.space.items[j])
                    end = min(end, 1.0 / self.table[LANE_BEST + i])
                    wide = 1.0
                self.table[LANE_AT + i] = self.beyond(i, u, v, wide)

    # -- whole fans --------------------------------------------------------------------

    def begin_bundles(
        self, dx: Floats, dy: Floats, begins: Floats, rate: float, at: Viewpoint, reach: float
    ) -> None:
        """Find how far each bundle of beams goes through empty space, at least [m].

        Args:
            dx: Directions of the middles of bundles.
            dy: See dx.
            begins: Comes out.
            rate: Beams a radian.
            at: Place of the sensor.
            reach: Range of the beams [m].
        """
        half = 0.5 * SIDE_BY_SIDE / rate
        spread = sine(half) / cosine(half)
        around = 4.0 * self.fine[COLUMNS] * self.fine[ROWS]
        base = 0
        while base < begins.shape[0]:
            count = min(MOST_LANES, begins.shape[0] - base)
            self.put(0, dx, dy, base, count, at, reach)
            for i in range(count):
                self.table[LANE_AT + i], self.table[LANE_BASE + i] = 0.0, around
                self.table[LANE_END + i] = self.table[LANE_OUT + i]
            self.march_bundles(count, spread)
            for i in range(count):
                begins[base + i] = self.table[LANE_AT + i]
            base += count

    def meet_ahead(
        self, beams: Beams, dx: Floats, dy: Floats, begins: Floats, at: Viewpoint
    ) -> None:
        """Intersect all beams of a fan with the statics.

        Arguments as ``begin_bundles`` has them.
        """
        narrow = NARROW * beams.rate > SIDE_BY_SIDE
        if narrow:
            self.begin_bundles(dx, dy, begins, beams.rate, at, beams.reach)
        base = 0
        while base < beams.count:
            count = min(SIDE_BY_SIDE, beams.count - base)
            self.put(0, beams.dx, beams.dy, base, count, at, beams.reach)
            if narrow:
                begin = begins[base // SIDE_BY_SIDE]
                for i in range(count):
                    self.table[LANE_AT + i] = max(self.table[LANE_AT + i], begin)
            self.meet_statics(count)
            for i in range(count):
                beams.best[base + i] = self.table[LANE_BEST + i]
                beams.who[base + i] = self.table[LANE_NAME + i]
            base += count

    def report(
        self, first: int, count: int, m: int, reach: float, missing: float, signed: bool,
        ranges: Floats, names: Floats,
    ) -> None:  # fmt: skip
        """Write down what the lanes of sensor m met, see ``Beams.report``."""
        for k in range(count):
            best, name = self.table[LANE_BEST + first + k], self.table[LANE_NAME + first + k]
            ranges[m, k] = 1.0 / best if best > 1.0 / reach else missing
            if signed and name < 0.0:
                ranges[m, k] = -INF
            if names.shape[0] > 0:
                names[m, k] = name
