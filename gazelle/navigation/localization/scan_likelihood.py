"""Likelihood of a scan at many poses on a map.

The models are those of Thrun, Burgard and Fox, "Probabilistic Robotics", 2005, chapter 6, mixed
over beams as ``amcl`` does it: by the sum of cubes.
"""

# mypy: disallow-untyped-decorators=False

import cython
import numpy as np
from cython.cimports.gazelle.native.elementary import cos, sin
from cython.cimports.libc.math import exp, floor

from gazelle.array_types import Bytes, Floats, Floats32

if not cython.compiled:
    LANES = 32  # in a compiled module, what scan_likelihood.pxd says


@cython.cclass
class LikelihoodField:
    """Likelihood of beams' ends, by the distance to the nearest obstacle on the map.

    Args:
        terms: Term of a beam's end in each cell, shape (rows, columns).
        origin: Of the map's lower left corner (x, y) [m].
        resolution: Side of a cell [m].
        outside: Term of an end off the map.
    """

    _rows: cython.int
    _columns: cython.int
    _terms: cython.float[::1]
    _above: cython.uchar[::1]
    _least: cython.double
    _x0: cython.double
    _y0: cython.double
    _cell: cython.double

    def __init__(
        self, terms: Floats32, origin: tuple[float, float], resolution: float, outside: float
    ) -> None:
        # A rim of one cell has what is outside: all ends beyond it are moved onto it.
        padded = np.pad(np.asarray(terms, np.float32), 1, constant_values=np.float32(outside))
        self._rows, self._columns = padded.shape
        self._terms = padded.ravel()
        self._above = np.zeros(0, np.uint8)
        self._least = float("nan")
        self._x0, self._y0, self._cell = origin[0], origin[1], resolution

    def scores(self, poses: Floats, points: Floats, first: float) -> Floats:
        """Return the sum of what the ends of beams add, at each pose, shape (n,).

        Args:
            poses: x, y [m] and heading [rad] of the robot, shape (n, 3).
            points: Ends of beams in the robot's frame [m], shape (m, 2).
            first: Initial value of each sum.
        """
        result = np.empty(len(poses))
        self._score(poses, points, first, result)
        return result

    def count_above(self, poses: Floats, points: Floats, least: float) -> Floats:
        """Return the number of poses at which each beam's end adds more than `least`, shape (m,).

        Only ends on the map count.
        """
        if self._least != least:
            above = (np.asarray(self._terms) > least).reshape(self._rows, self._columns)
            above[[0, -1]] = above[:, [0, -1]] = False
            self._above, self._least = above.ravel().view(np.uint8), least
        result = np.zeros(len(points))
        self._count(poses, points, result)
        return result

    @cython.cfunc
    @cython.exceptval(check=False)
    def _count(
        self,
        poses: cython.double[:, ::1],
        points: cython.double[:, ::1],
        result: cython.double[::1],
    ) -> cython.void:
        block = cython.declare(cython.double[128])
        cells = cython.declare(cython.int[32])
        n: cython.Py_ssize_t
        i: cython.Py_ssize_t
        k: cython.int
        above: cython.uchar[::1] = self._above
        for n in range(0, poses.shape[0], LANES):
            self._place(poses, n, block)
            used: cython.int = min(LANES, poses.shape[0] - n)
            for i in range(points.shape[0]):
                self._find(block, points[i, 0], points[i, 1], cells)
                for k in range(used):
                    result[i] += above[cells[k]]

    @cython.cfunc
    @cython.exceptval(check=False)
    def _score(
        self,
        poses: cython.double[:, ::1],
        points: cython.double[:, ::1],
        first: cython.double,
        result: cython.double[::1],
    ) -> cython.void:
        block = cython.declare(cython.double[128])
        cells = cython.declare(cython.int[32])
        totals = cython.declare(cython.double[32])
        n: cython.Py_ssize_t
        i: cython.Py_ssize_t
        k: cython.int
        terms: cython.float[::1] = self._terms
        for n in range(0, poses.shape[0], LANES):
            self._place(poses, n, block)
            for k in range(LANES):
                totals[k] = first
            for i in range(points.shape[0]):
                self._find(block, points[i, 0], points[i, 1], cells)
                for k in range(LANES):
                    totals[k] += cython.cast(cython.double, terms[cells[k]])
            for k in range(min(LANES, poses.shape[0] - n)):
                result[n + k] = totals[k]

    @cython.cfunc
    @cython.inline
    @cython.exceptval(check=False)
    def _place(
        self, poses: cython.double[:, ::1], first: cython.Py_ssize_t, block: cython.p_double
    ) -> cython.void:
        """Fill a block with robots' positions and headings, in cells; pad it with the last robot."""
        k: cython.int
        scale: cython.double = 1.0 / self._cell
        for k in range(LANES):
            n: cython.Py_ssize_t = min(first + k, poses.shape[0] - 1)
            block[k] = (poses[n, 0] - self._x0) * scale + 1.0
            block[LANES + k] = (poses[n, 1] - self._y0) * scale + 1.0
            block[2 * LANES + k] = cos(poses[n, 2]) * scale
            block[3 * LANES + k] = sin(poses[n, 2]) * scale

    @cython.cfunc
    @cython.inline
    @cython.exceptval(check=False)
    def _find(
        self, block: cython.p_double, px: cython.double, py: cython.double, cells: cython.p_int
    ) -> cython.void:
        """Find the cells of a beam's end, for each robot of a block.

        Robots are taken together as their sums do not wait for one another, and as this has no
        branches a compiler makes vectors of it.
        """
        k: cython.int
        columns: cython.int = self._columns
        right: cython.double = self._columns - 1
        top: cython.double = self._rows - 1
        for k in range(LANES):
            c: cython.double = block[2 * LANES + k]
            s: cython.double = block[3 * LANES + k]
            x: cython.double = block[k] + c * px - s * py
            y: cython.double = block[LANES + k] + s * px + c * py
            # In this order what is not a number comes to the rim, too.
            x = max(0.0, x)
            y = max(0.0, y)
            x = min(right, x)
            y = min(top, y)
            cells[k] = cython.cast(cython.int, y) * columns + cython.cast(cython.int, x)


@cython.cclass
class BeamModel:
    """Likelihood of ranges, compared with those that rays on the map would have.

    Args:
        occupied: Not 0 where a ray ends: at obstacles and at what is unknown, shape (rows, columns).
        origin: Of the map's lower left corner (x, y) [m].
        resolution: Side of a cell [m].
        weights: Of hits, short ones, greatest ranges and random ones, shape (4,).
        sigma: Of hits [m].
        decay: Of short ones [1/m].
    """

    _occupied: cython.uchar[:, ::1]
    _x0: cython.double
    _y0: cython.double
    _cell: cython.double
    _weights: cython.double[::1]
    _sigma: cython.double
    _decay: cython.double

    def __init__(
        self,
        occupied: Bytes,
        origin: tuple[float, float],
        resolution: float,
        weights: Floats,
        sigma: float,
        decay: float,
    ) -> None:
        self._occupied = np.ascontiguousarray(occupied, np.uint8)
        self._x0, self._y0, self._cell = origin[0], origin[1], resolution
        self._weights = np.array(weights, np.float64)
        self._sigma, self._decay = sigma, decay

    def scores(self, poses: Floats, beams: Floats, most: float) -> Floats:
        """Return 1 plus the sum of cubes of beams' probabilities, at each pose, shape (n,).

        Args:
            poses: x, y [m] and heading [rad] of the laser, shape (n, 3).
            beams: Ranges [m] and angles in the laser's frame [rad], shape (m, 2).
            most: Greatest range [m].
        """
        result = np.empty(len(poses))
        self._score(poses, beams, most, result)
        return result

    def range_at(self, x: float, y: float, heading: float, most: float) -> float:
        """Return the range of a ray on the map [m]."""
        return float(self._range(x, y, heading, most))

    @cython.cfunc
    @cython.exceptval(check=False)
    def _score(
        self,
        poses: cython.double[:, ::1],
        beams: cython.double[:, ::1],
        most: cython.double,
        result: cython.double[::1],
    ) -> cython.void:
        n: cython.Py_ssize_t
        i: cython.Py_ssize_t
        count: cython.Py_ssize_t = poses.shape[0]
        scanned: cython.Py_ssize_t = beams.shape[0]
        square: cython.double = 2.0 * self._sigma * self._sigma
        for n in range(count):
            total: cython.double = 1.0
            for i in range(scanned):
                seen: cython.double = beams[i, 0]
                at: cython.double = self._range(
                    poses[n, 0], poses[n, 1], poses[n, 2] + beams[i, 1], most
                )
                off: cython.double = seen - at
                p: cython.double = self._weights[0] * exp(-(off * off) / square)
                if off < 0.0:
                    p += self._weights[1] * self._decay * exp(-self._decay * seen)
                if seen >= most:
                    p += self._weights[2]
                else:
                    p += self._weights[3] / most
                total += p * p * p
            result[n] = total

    @cython.cfunc
    @cython.exceptval(check=False)
    def _range(
        self, x: cython.double, y: cython.double, heading: cython.double, most: cython.double
    ) -> cython.double:
        """Return the range of a ray, from cell to cell (J.

        Amanatides and A. Woo, 1987). Amanatides and A. Woo, 1987).
        """
        c: cython.double = cos(heading)
        s: cython.double = sin(heading)
        px: cython.double = (x - self._x0) / self._cell
        py: cython.double = (y - self._y0) / self._cell
        limit: cython.double = most / self._cell
        column: cython.int = cython.cast(cython.int, floor(px))
        row: cython.int = cython.cast(cython.int, floor(py))
        step_x: cython.int = 1 if c > 0.0 else -1
        step_y: cython.int = 1 if s > 0.0 else -1
        delta_x: cython.double = 1.0 / c if c > 0.0 else -1.0 / c if c < 0.0 else 1e30
        delta_y: cython.double = 1.0 / s if s > 0.0 else -1.0 / s if s < 0.0 else 1e30
        next_x: cython.double = (column + 1 - px if c > 0.0 else px - column) * delta_x
        next_y: cython.double = (row + 1 - py if s > 0.0 else py - row) * delta_y
        gone: cython.double = 0.0
        while gone < limit:
            if (
                column < 0
                or row < 0
                or column >= self._occupied.shape[1]
                or row >= self._occupied.shape[0]
            ):
                return most
            if self._occupied[row, column]:
                return gone * self._cell
            if next_x < next_y:
                gone = next_x
                next_x += delta_x
                column += step_x
            else:
                gone = next_y
                next_y += delta_y
                row += step_y
        return most
