# cython: infer_types=True, annotation_typing=False
"""Visible objects from a sensor's position: found row by row of cells, and drawn.

Nothing is done a beam and cell, so the cost grows with what is in view, not with the number of
beams times the way they go, nor with the number of bodies in the world.
"""

# ruff: noqa: FBT001, PLW3301  # arguments in order; loops that become vectors

from __future__ import annotations

import cython
import numpy as np
from cython.cimports.gazelle.engines.planar import columns as col
from cython.cimports.gazelle.engines.planar import scan_columns as scan
from cython.cimports.gazelle.engines.planar.beams import Beams, Candidates
from cython.cimports.gazelle.engines.planar.bodies import Bodies
from cython.cimports.gazelle.engines.planar.grid_cells import place_in
from cython.cimports.libc.math import sqrt

from gazelle.array_types import Floats

INF = cython.declare(cython.double, float("inf"))
RINGS = cython.declare(cython.int, 16)  # by which bodies are sorted
FEW = cython.declare(cython.int, 48)  # beams from which it pays to find out which ones are missed
BLOCK = cython.declare(cython.int, 64)  # primitives that are prepared at once
CROWD = cython.declare(cython.int, 128)  # bodies that are sorted at once


class Viewpoint:
    """Pose of a sensor, and the memory that a thread uses while it scans.

    Args:
        bodies: Bodies that can be seen.
        beams: Of the fan; written on.
        outline: Corners of a convex polygon around all that can be seen, in the sensor's frame
            [m], shape (n, 2).

    Attributes:
        x: In the world [m].
        y: See x.
        cos: Of its heading.
        sin: Of its heading.
        z: Its height [m].
        owner: Its body, counted through all worlds.
        world: In which it is.
        family: Of the owner; its members are not seen.
    """

    def __init__(self, bodies: Bodies, beams: Beams, outline: Floats) -> None:
        self.bodies, self.beams, self.outline = bodies, beams, outline
        self.view = np.zeros_like(outline)
        self.walls, self.others = Candidates(), Candidates()
        self.sorted = Candidates()
        self.rings = np.zeros(RINGS)
        self.stamp = np.zeros(len(bodies.statics) + 1, np.int64)

    def aim(self, mounts: Floats, m: int, owner: int) -> None:
        """Move the viewpoint to sensor m: the mounts are on the bodies ``owner``, by turns."""
        j = m % mounts.shape[0]
        c, s = self.bodies.rows[owner, col.COS], self.bodies.rows[owner, col.SIN]
        self.x = self.bodies.rows[owner, col.X] + c * mounts[j, col.S_X] - s * mounts[j, col.S_Y]
        self.y = self.bodies.rows[owner, col.Y] + s * mounts[j, col.S_X] + c * mounts[j, col.S_Y]
        self.cos = c * mounts[j, col.S_COS] - s * mounts[j, col.S_SIN]
        self.sin = s * mounts[j, col.S_COS] + c * mounts[j, col.S_SIN]
        self.z = self.bodies.rows[owner, col.Z] + mounts[j, col.S_Z]
        self.owner, self.world = owner, owner // self.bodies.nbody
        self.family = self.bodies.kinds[owner - self.world * self.bodies.nbody, col.FAMILY]

    # -- cells in view -----------------------------------------------------------------

    def put_view(self, share: float) -> None:
        """Find corners around all that is seen up to a share of the reach."""
        for k in range(self.outline.shape[0]):
            x, y = share * self.outline[k, 0], share * self.outline[k, 1]
            self.view[k, 0] = self.x + self.cos * x - self.sin * y
            self.view[k, 1] = self.y + self.sin * x + self.cos * y

    def extent(self, low: float, high: float) -> tuple[float, float]:
        """Return least and greatest x of the view between two heights; (inf, -inf) without any."""
        left, right = INF, -INF
        count = self.view.shape[0]
        for k in range(count):
            j = k + 1 if k + 1 < count else 0
            x0, y0, x1, y1 = self.view[k, 0], self.view[k, 1], self.view[j, 0], self.view[j, 1]
            if (y0 < low and y1 < low) or (y0 > high and y1 > high):
                continue
            t0, t1, dy = 0.0, 1.0, y1 - y0
            if dy != 0.0:
                a, b = (low - y0) / dy, (high - y0) / dy
                t0, t1 = max(min(a, b), 0.0), min(max(a, b), 1.0)
            xa, xb = x0 + t0 * (x1 - x0), x0 + t1 * (x1 - x0)
            left, right = min(left, min(xa, xb)), max(right, max(xa, xb))
        return left, right

    def rows_of(self, widest: float) -> tuple[int, int]:
        """Return first and last row of cells that the view, widened by a radius, passes."""
        if self.bodies.grid[4] == 1.0:
            return 0, 0
        low, high = INF, -INF
        for k in range(self.view.shape[0]):
            low, high = min(low, self.view[k, 1]), max(high, self.view[k, 1])
        bottom = place_in(
            low - widest, self.bodies.grid[1], self.bodies.grid[2], self.bodies.grid[4]
        )
        return bottom, place_in(
            high + widest, self.bodies.grid[1], self.bodies.grid[2], self.bodies.grid[4]
        )

    def cells_of(self, widest: float, r: int) -> tuple[int, int]:
        """Return first and last cell of row r that the view, widened by a radius, passes."""
        base = r * cython.cast(cython.Py_ssize_t, self.bodies.grid[3])
        if self.bodies.grid[3] == 1.0:
            return base, base
        side, y = self.bodies.grid[2], self.bodies.grid[1]
        below = y + r * side - widest if r > 0 else -INF
        above = y + (r + 1) * side + widest if r < self.bodies.grid[4] - 1 else INF
        left, right = self.extent(below, above)
        if right < left:
            return base, base - 1
        first = place_in(left - widest, self.bodies.grid[0], side, self.bodies.grid[3])
        return base + first, base + place_in(
            right + widest, self.bodies.grid[0], side, self.bodies.grid[3]
        )

    def is_crowded(self, most: int) -> bool:
        """Return whether more than this many statics are listed in cells in view."""
        bottom, top = self.rows_of(0.0)
        listed = 0
        for r in range(bottom, top + 1):
            left, right = self.cells_of(0.0, r)
            listed += self.bodies.start[right + 1] - self.bodies.start[left]
        return listed > most

    # -- drawing -----------------------------------------------------------------------

    def draw(self, drawn: bool) -> None:
        """Draw everything in view except the owner's family; statics may be ``drawn`` already."""
        self.stamp[self.bodies.statics.shape[0]] += 1
        x = -self.cos * self.x - self.sin * self.y
        y = self.sin * self.x - self.cos * self.y
        few = self.bodies.lanes.shape[1]
        if few > 0 and not drawn:
            self.find_lanes(x, y)
            self.walls.draw(few, self.beams)
        n, q = 0, 0
        base = self.world * self.bodies.nbody
        bottom, top = self.rows_of(self.bodies.widest)
        for r in range(bottom, top + 1):
            left, right = self.cells_of(self.bodies.widest, r)
            if few == 0 and not drawn:
                n = self.find_statics(
                    n, self.bodies.start[left], self.bodies.start[right + 1], x, y
                )
            for cell in range(left, right + 1):
                b = cython.cast(cython.Py_ssize_t, self.bodies.head[self.world, cell])
                while b >= 0:
                    if self.bodies.kinds[b - base, col.FAMILY] != self.family:
                        q = self.find_body(q, b - base, b)
                        if q == CROWD:
                            self.draw_others(q)
                            q = 0
                    b = self.bodies.follow[b]
        if n > 0:
            self.walls.solve_and_draw(n, self.beams)
        if q > 0:
            self.draw_others(q)

    # -- statics -----------------------------------------------------------------------

    def find_static(self, n: int, s: int, x: float, y: float) -> int:
        """Write down a static primitive as the n-th wall if it can be seen; returns how many.

        The world's origin is at (x, y) in the sensor's frame.
        """
        reach = self.beams.reach
        if (
            self.bodies.statics[s, col.GLOW] < 0.0
            or self.z < self.bodies.statics[s, col.LOW]
            or self.z > self.bodies.statics[s, col.HIGH]
        ):
            return n
        cos, sin = self.cos, -self.sin
        ax, ay = self.bodies.statics[s, col.X0], self.bodies.statics[s, col.Y0]
        bx, by = self.bodies.statics[s, col.X1], self.bodies.statics[s, col.Y1]
        x0, y0 = x + cos * ax - sin * ay, y + sin * ax + cos * ay
        x1, y1 = x + cos * bx - sin * by, y + sin * bx + cos * by
        radius = 0.0
        if (
            cython.cast(cython.int, self.bodies.statics[s, col.KIND])
            & cython.cast(cython.int, col.CIRCLE)
        ) != 0:
            radius = bx
        if radius > 0.0:
            x1, y1, far = x0, y0, reach + radius
            if x0 * x0 + y0 * y0 > far * far:
                return n
        else:
            cross, ex, ey = x0 * y1 - x1 * y0, x1 - x0, y1 - y0
            if cross * cross > reach * reach * (ex * ex + ey * ey):
                return n
        (
            self.walls.table[scan.C_X0 + n],
            self.walls.table[scan.C_Y0 + n],
            self.walls.table[scan.C_X1 + n],
            self.walls.table[scan.C_Y1 + n],
        ) = x0, y0, x1, y1
        self.walls.table[scan.C_RADIUS + n], self.walls.table[scan.C_NAME + n] = radius, s + 1.0
        return n + 1

    def find_lanes(self, x: float, y: float) -> None:
        """Write down and solve all statics of a world with few of them.

        Those that cannot be seen are a share 0 of any distance: never met.
        """
        height, cos, sin = self.z, self.cos, -self.sin
        for i in range(self.bodies.lanes.shape[1]):
            ax, ay, bx, by = (
                self.bodies.lanes[col.X0, i], self.bodies.lanes[col.Y0, i], self.bodies.lanes[col.X1, i], self.bodies.lanes[col.Y1, i],
            )  # fmt: skip
            x0, y0 = x + cos * ax - sin * ay, y + sin * ax + cos * ay
            x1, y1 = x + cos * bx - sin * by, y + sin * bx + cos * by
            radius, name = self.bodies.lanes[col.L_RADIUS, i], i + 1.0
            circle, line = x0 * x0 + y0 * y0 - radius * radius, x0 * y1 - x1 * y0
            cross = circle if radius > 0.0 else line
            seen = (
                (self.bodies.lanes[col.L_GLOW, i] >= 0.0)
                & (height >= self.bodies.lanes[col.L_LOW, i])
                & (height <= self.bodies.lanes[col.L_HIGH, i])
                & (cross != 0.0)
            )
            disc = (radius > 0.0) | (cross < 0.0)
            (
                self.walls.table[scan.C_X0 + i],
                self.walls.table[scan.C_Y0 + i],
                self.walls.table[scan.C_X1 + i],
                self.walls.table[scan.C_Y1 + i],
            ) = x0, y0, x1, y1
            self.walls.table[scan.C_RADIUS + i] = radius
            self.walls.table[scan.C_NAME + i] = name if disc else -name
            self.walls.table[scan.C_INVERSE + i] = 1.0 / cross if seen else 0.0

    def find_statics(self, n: int, first: int, last: int, x: float, y: float) -> int:
        """Write down statics of some cells; draw them when there are many.

        ``stamp`` holds the scan that came last to each: each is drawn once a scan.
        """
        now = self.stamp[self.stamp.shape[0] - 1]
        for i in range(first, last):
            p = cython.cast(cython.Py_ssize_t, self.bodies.items[i])
            if self.stamp[p] == now:
                continue
            self.stamp[p] = now
            n = self.find_static(n, p, x, y)
            if n == BLOCK:
                self.walls.solve_and_draw(n, self.beams)
                n = 0
        return n

    # -- bodies ------------------------------------------------------------------------

    def find_body(self, n: int, k: int, b: int) -> int:
        """Write down body b, of kind k, as the n-th if it can be seen; returns how many."""
        ox, oy = self.bodies.rows[b, col.X] - self.x, self.bodies.rows[b, col.Y] - self.y
        radius = self.bodies.kinds[k, col.RADIUS]
        far = self.beams.reach + radius
        if ox * ox + oy * oy > far * far:
            return n
        c, s = self.cos, self.sin
        self.others.table[scan.C_X0 + n], self.others.table[scan.C_Y0 + n] = (
            c * ox + s * oy,
            c * oy - s * ox,
        )
        self.others.table[scan.C_COS + n] = (
            c * self.bodies.rows[b, col.COS] + s * self.bodies.rows[b, col.SIN]
        )
        self.others.table[scan.C_SIN + n] = (
            c * self.bodies.rows[b, col.SIN] - s * self.bodies.rows[b, col.COS]
        )
        self.others.table[scan.C_RADIUS + n], self.others.table[scan.C_NAME + n] = radius, b
        return n + 1

    def sort_others(self, n: int) -> None:
        """Copy the first n bodies found to ``sorted``, about the nearest first.

        Then those that are hidden by others need not be drawn.
        """
        for ring in range(RINGS):
            self.rings[ring] = 0.0
        share = RINGS / self.beams.reach
        for i in range(n):
            x, y = self.others.table[scan.C_X0 + i], self.others.table[scan.C_Y0 + i]
            self.others.table[scan.C_SPAN + i] = min(sqrt(x * x + y * y) * share, RINGS - 1.0)
        for i in range(n):
            self.rings[cython.cast(cython.Py_ssize_t, self.others.table[scan.C_SPAN + i])] += 1.0
        before = 0.0
        for ring in range(RINGS):
            here = self.rings[ring]
            self.rings[ring] = before
            before += here
        for i in range(n):
            place = cython.cast(cython.Py_ssize_t, self.others.table[scan.C_SPAN + i])
            at = cython.cast(cython.Py_ssize_t, self.rings[place])
            self.rings[place] += 1.0
            self.sorted.table[scan.C_X0 + at], self.sorted.table[scan.C_Y0 + at], self.sorted.table[scan.C_X1 + at], self.sorted.table[scan.C_Y1 + at] = (
                self.others.table[scan.C_X0 + i], self.others.table[scan.C_Y0 + i], self.others.table[scan.C_X0 + i], self.others.table[scan.C_Y0 + i],
            )  # fmt: skip
            self.sorted.table[scan.C_COS + at], self.sorted.table[scan.C_SIN + at] = (
                self.others.table[scan.C_COS + i],
                self.others.table[scan.C_SIN + i],
            )
            self.sorted.table[scan.C_RADIUS + at], self.sorted.table[scan.C_NAME + at] = (
                self.others.table[scan.C_RADIUS + i],
                self.others.table[scan.C_NAME + i],
            )

    def draw_others(self, n: int) -> None:
        """Draw the first n bodies found."""
        self.sort_others(n)
        count = self.beams.count
        many = count > FEW
        if many:
            self.sorted.cover(n, self.beams)
        for i in range(n):
            b = cython.cast(cython.Py_ssize_t, self.sorted.table[scan.C_NAME + i])
            k = b - self.world * self.bodies.nbody
            x, y = self.sorted.table[scan.C_X0 + i], self.sorted.table[scan.C_Y0 + i]
            nearest = sqrt(x * x + y * y) - self.sorted.table[scan.C_RADIUS + i]
            away = nearest > 0.0 and nearest * self.beams.near >= 1.0
            height = self.z - self.bodies.rows[b, col.Z]
            name = col.NAMES * (b + 1.0)
            if not many:
                self.draw_visuals(0, count, k, height, i, away, name)
                continue
            for turn in range(2):
                lo, hi = self.beams.between(
                    self.sorted.table[scan.C_FIRST + i], self.sorted.table[scan.C_SPAN + i], -turn
                )
                if lo >= hi or (away and self.beams.hidden(lo, hi, 1.0 / nearest)):
                    continue
                self.draw_visuals(lo, hi, k, height, i, away, name)

    def draw_visuals(
        self, lo: int, hi: int, k: int, height: float, i: int, away: bool, name: float,
    ) -> None:  # fmt: skip
        """Draw primitives of the i-th body, of kind k, into beams lo to hi.

        Of closed outlines that beams begin ``away`` from only the front is drawn.
        """
        x, y = self.sorted.table[scan.C_X0 + i], self.sorted.table[scan.C_Y0 + i]
        cos, sin = self.sorted.table[scan.C_COS + i], self.sorted.table[scan.C_SIN + i]
        first = cython.cast(cython.Py_ssize_t, self.bodies.kinds[k, col.FIRST_VISUAL])
        last = cython.cast(cython.Py_ssize_t, self.bodies.kinds[k, col.LAST_VISUAL])
        for p in range(first, last):
            if (
                self.bodies.visuals[p, col.GLOW] < 0.0
                or height < self.bodies.visuals[p, col.LOW]
                or height > self.bodies.visuals[p, col.HIGH]
            ):
                continue
            ax, ay = self.bodies.visuals[p, col.X0], self.bodies.visuals[p, col.Y0]
            bx, by = self.bodies.visuals[p, col.X1], self.bodies.visuals[p, col.Y1]
            x0, y0 = x + cos * ax - sin * ay, y + sin * ax + cos * ay
            x1, y1 = x + cos * bx - sin * by, y + sin * bx + cos * by
            kind = cython.cast(cython.int, self.bodies.visuals[p, col.KIND])
            circle = (kind & cython.cast(cython.int, col.CIRCLE)) != 0
            cross = x0 * x0 + y0 * y0 - bx * bx if circle else x0 * y1 - x1 * y0
            back = cross > 0.0 and not circle
            if cross == 0.0 or (back and away and (kind & cython.cast(cython.int, col.OPEN)) == 0):
                continue
            inverse = 1.0 / cross
            if circle:
                self.beams.draw_circle(lo, hi, x0, y0, bx * bx, inverse, name + p)
            else:
                seen = -name - p if back else name + p
                self.beams.draw_segment(lo, hi, x0, y0, x1, y1, inverse, seen)
