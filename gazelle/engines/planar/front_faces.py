# cython: infer_types=True, annotation_typing=False
"""Scans of small scenes from outside of everything: only what faces the sensor is drawn.

It gives the ranges that ``Viewpoint.draw`` gives, but for rounding where a beam touches a corner.
Where a sensor or the begin of a beam may be inside something, it says so, and nothing is sure.
"""

# arguments in order; loops that become vectors

from __future__ import annotations

import cython
import numpy as np
from cython.cimports.gazelle.engines.planar.beams import Beams, Candidates
from cython.cimports.gazelle.engines.planar.columns import COS, FAMILY, RADIUS, SIN, X, Y, Z
from cython.cimports.gazelle.engines.planar.scan_columns import (
    C_FIRST,
    C_INVERSE,
    C_RADIUS,
    C_SPAN,
    C_X0,
    C_X1,
    C_Y0,
    C_Y1,
    F_AX,
    F_AY,
    F_BX,
    F_BY,
    F_HIGH,
    F_INVERSE,
    F_LOW,
    F_OPEN,
    F_TURNS,
    F_X0,
    F_X1,
    F_Y0,
    F_Y1,
    ROOM,
)  # fmt: skip
from cython.cimports.gazelle.engines.planar.viewpoint import Viewpoint
from numpy.typing import NDArray

from gazelle.array_types import Floats

TOUCHED = cython.declare(cython.double, 1e9)  # more than there are sides
MARGIN = cython.declare(cython.double, 1e-6)  # beyond the reach, where rounding hides nothing [m]
FEW = cython.declare(cython.int, 48)  # beams from which it pays to find out which ones are missed


class FrontFaces:
    """The sides of all that there is, and which of them face a sensor.

    Args:
        sides: Of statics, then of each body in its own frame: both ends [m], whether from both
            sides, and their lowest and highest height [m], shape (n, 7); with the discs at most ``ROOM``.
        statics: Number of those of statics.
        discs: Static discs: middle, radius, lowest and highest height [m], shape (m, 5).
        rounds: As ``discs``, of bodies.
        spans: Of each body the first side and the one after the last, and so for discs, shape
            (nbody, 4).
    """

    def __init__(
        self,
        sides: Floats,
        statics: int,
        discs: Floats,
        rounds: Floats,
        spans: NDArray[np.int64],
    ) -> None:
        table = np.zeros((13, ROOM))
        table[:7, : len(sides)] = sides.T
        self.table, self.statics = table.ravel(), statics
        self.discs, self.rounds, self.spans = discs, rounds, spans
        self.order = np.zeros(ROOM + 1, np.int64)
        self.found = Candidates()

    def find_faces(
        self, n: int, first: int, last: int, reach: float, height: float, x: float, y: float,
        cos: float, sin: float,
    ) -> int:  # fmt: skip
        """Transform sides to the sensor's frame, and list the visible ones.

        Those of closed outlines around the sensor, which pass the sensor's x axis once more from
        one side than from the other, are counted in ``inside``, as are sides that it is on.

        Args:
            n: Number of listed faces.
            first: Of the sides.
            last: The one after the last.
            reach: Range of the sensor [m].
            height: Of the sensor above their frame [m].
            x: Their frame in that of the sensor: origin [m], cosine and sine of its heading.
            y: See x.
            cos: See x.
            sin: See x.

        Returns:
            How many are listed then.
        """
        for i in range(first, last):
            ax, ay = self.table[F_AX + i], self.table[F_AY + i]
            bx, by = self.table[F_BX + i], self.table[F_BY + i]
            x0, y0 = x + cos * ax - sin * ay, y + sin * ax + cos * ay
            x1, y1 = x + cos * bx - sin * by, y + sin * bx + cos * by
            cross, ex, ey = x0 * y1 - x1 * y0, x1 - x0, y1 - y0
            near = cross * cross <= reach * reach * (ex * ex + ey * ey)
            closed = self.table[F_OPEN + i] <= 0.0
            front = (cross < 0.0) | ((self.table[F_OPEN + i] > 0.0) & (cross != 0.0))
            level = (height >= self.table[F_LOW + i]) & (height <= self.table[F_HIGH + i])
            up = level & closed & (y0 <= 0.0) & (y1 > 0.0) & (cross > 0.0)
            down = level & closed & (y0 > 0.0) & (y1 <= 0.0) & (cross < 0.0)
            touched = level & closed & (cross == 0.0) & (x0 * x1 + y0 * y1 <= 0.0)
            turns = (1.0 if up else 0.0) - (1.0 if down else 0.0)
            self.table[F_TURNS + i] = TOUCHED if touched else turns
            self.table[F_X0 + i], self.table[F_Y0 + i] = x0, y0
            self.table[F_X1 + i], self.table[F_Y1 + i] = x1, y1
            self.table[F_INVERSE + i] = 1.0 / cross if near & front & level else 0.0
        for k in range(first, last):
            self.inside += self.table[F_TURNS + k]
            self.order[n] = k
            n += self.table[F_INVERSE + k] != 0.0
        return n

    def take_disc(self, x: float, y: float, radius: float, beams: Beams) -> bool:
        """Draw a disc, or list it where there are many beams; False if the sensor is within."""
        square, far = x * x + y * y, beams.reach + radius + MARGIN
        outside = square - radius * radius
        if outside <= 0.0:
            return False
        if square > far * far:
            return True
        if beams.count <= FEW:
            beams.draw_disc(0, beams.count, x, y, radius, 1.0 / outside)
            return True
        i = self.listed
        self.found.table[C_X0 + i], self.found.table[C_Y0 + i] = x, y
        self.found.table[C_X1 + i], self.found.table[C_Y1 + i] = x, y
        self.found.table[C_RADIUS + i], self.found.table[C_INVERSE + i] = radius, 1.0 / outside
        self.listed += 1
        return True

    def find_bodies(self, at: Viewpoint, beams: Beams) -> int:
        """Draw round bodies other than the owner's family, and list sides; -1 if not sure."""
        n = 0
        nbody = at.bodies.nbody
        c, s = at.cos, at.sin
        for k in range(nbody):
            b = at.world * nbody + k
            ox, oy = at.bodies.rows[b, X] - at.x, at.bodies.rows[b, Y] - at.y
            far = beams.reach + at.bodies.kinds[k, RADIUS]
            if at.bodies.kinds[k, FAMILY] == at.family or ox * ox + oy * oy > far * far:
                continue
            height = at.z - at.bodies.rows[b, Z]
            x, y = c * ox + s * oy, c * oy - s * ox
            cos = c * at.bodies.rows[b, COS] + s * at.bodies.rows[b, SIN]
            sin = c * at.bodies.rows[b, SIN] - s * at.bodies.rows[b, COS]
            n = self.find_faces(
                n, self.spans[k, 0], self.spans[k, 1], beams.reach, height, x, y, cos, sin,
            )  # fmt: skip
            for p in range(self.spans[k, 2], self.spans[k, 3]):
                if height < self.rounds[p, 3] or height > self.rounds[p, 4]:
                    continue
                ax, ay, radius = self.rounds[p, 0], self.rounds[p, 1], self.rounds[p, 2]
                x0, y0 = x + cos * ax - sin * ay, y + sin * ax + cos * ay
                if not self.take_disc(x0, y0, radius, beams):
                    return -1
        return n

    def draw(self, n: int, beams: Beams) -> None:
        """Draw the first n sides listed, and the discs."""
        if beams.count <= FEW:
            for i in range(n // 2):
                j, k = self.order[2 * i], self.order[2 * i + 1]
                beams.draw_two(
                    self.table[F_X0 + j], self.table[F_Y0 + j], self.table[F_X1 + j], self.table[F_Y1 + j], self.table[F_INVERSE + j], self.table[F_X0 + k],
                    self.table[F_Y0 + k], self.table[F_X1 + k], self.table[F_Y1 + k], self.table[F_INVERSE + k],
                )  # fmt: skip
            if n % 2 == 1:
                k = self.order[n - 1]
                beams.draw_front(
                    0,
                    beams.count,
                    self.table[F_X0 + k],
                    self.table[F_Y0 + k],
                    self.table[F_X1 + k],
                    self.table[F_Y1 + k],
                    self.table[F_INVERSE + k],
                )
            return
        discs = self.listed
        for i in range(n):
            k = self.order[i]
            self.found.table[C_X0 + discs + i] = self.table[F_X0 + k]
            self.found.table[C_Y0 + discs + i] = self.table[F_Y0 + k]
            self.found.table[C_X1 + discs + i] = self.table[F_X1 + k]
            self.found.table[C_Y1 + discs + i] = self.table[F_Y1 + k]
            self.found.table[C_RADIUS + discs + i] = 0.0
            self.found.table[C_INVERSE + discs + i] = self.table[F_INVERSE + k]
        self.found.cover(discs + n, beams)
        for i in range(discs + n):
            x0, y0 = self.found.table[C_X0 + i], self.found.table[C_Y0 + i]
            inverse = self.found.table[C_INVERSE + i]
            for turn in range(2):
                lo, hi = beams.between(
                    self.found.table[C_FIRST + i], self.found.table[C_SPAN + i], -turn
                )
                if lo < hi and i < discs:
                    beams.draw_disc(lo, hi, x0, y0, self.found.table[C_RADIUS + i], inverse)
                elif lo < hi:
                    x1, y1 = self.found.table[C_X1 + i], self.found.table[C_Y1 + i]
                    beams.draw_front(lo, hi, x0, y0, x1, y1, inverse)

    def look(self, at: Viewpoint, beams: Beams) -> bool:
        """Scan into ``beams.best`` from outside of everything; False if that is not sure."""
        beams.clear()
        self.inside, self.listed = 0.0, 0
        n = self.find_bodies(at, beams)
        if n < 0:
            return False
        c, s = at.cos, at.sin
        for i in range(self.discs.shape[0]):
            if at.z < self.discs[i, 3] or at.z > self.discs[i, 4]:
                continue
            x0 = (-c * at.x - s * at.y) + c * self.discs[i, 0] + s * self.discs[i, 1]
            y0 = (s * at.x - c * at.y) - s * self.discs[i, 0] + c * self.discs[i, 1]
            if not self.take_disc(x0, y0, self.discs[i, 2], beams):
                return False
        x, y = -c * at.x - s * at.y, s * at.x - c * at.y
        n = self.find_faces(n, 0, self.statics, beams.reach, at.z, x, y, c, -s)
        if self.inside != 0.0:
            return False
        self.draw(n, beams)
        return not beams.too_near()
