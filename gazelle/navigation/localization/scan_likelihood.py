"""How likely a scan is at many poses on a map.

The models are those of Thrun, Burgard and Fox, "Probabilistic Robotics", 2005, chapter 6, mixed
over beams as ``amcl`` does it: by the sum of cubes.
"""

# mypy: disallow-untyped-decorators=False

import cython
import numpy as np
from cython.cimports.gazelle.native.elementary import cos, sin
from cython.cimports.libc.math import exp, floor

from gazelle.array_types import Bytes, Floats, Floats32


@cython.cclass
class LikelihoodField:
    """How well what a beam ends on fits the map, by the distance to the nearest obstacle there.

    Args:
        terms: What a beam's end in each cell adds, shape (rows, columns).
        origin: Of the map's lower left corner (x, y) [m].
        resolution: Side of a cell [m].
        outside: What an end off the map adds.
    """

    _terms: cython.float[:, ::1]
    _x0: cython.double
    _y0: cython.double
    _cell: cython.double
    _outside: cython.double

    def __init__(
        self, terms: Floats32, origin: tuple[float, float], resolution: float, outside: float
    ) -> None:
        # A rim of one cell has what is outside, so that a place just off the map needs no case.
        self._terms = np.pad(np.asarray(terms, np.float32), 1, constant_values=np.float32(outside))
        self._x0, self._y0, self._cell = origin[0], origin[1], resolution
        self._outside = outside

    def scores(self, poses: Floats, points: Floats, first: float) -> Floats:
        """The sum of what the ends of beams add, at each pose, shape (n,).

        Args:
            poses: x, y [m] and heading [rad] of the robot, shape (n, 3).
            points: Ends of beams in the robot's frame [m], shape (m, 2).
            first: What each sum begins with.
        """
        result = np.empty(len(poses))
        self._score(poses, points, first, result)
        return result

    def count_above(self, poses: Floats, points: Floats, least: float) -> Floats:
        """At how many poses each beam's end adds more than `least`, shape (m,)."""
        result = np.zeros(len(points))
        self._count(poses, points, least, result)
        return result

    @cython.cfunc
    @cython.exceptval(check=False)
    def _count(
        self,
        poses: cython.double[:, ::1],
        points: cython.double[:, ::1],
        least: cython.double,
        result: cython.double[::1],
    ) -> cython.void:
        n: cython.Py_ssize_t
        i: cython.Py_ssize_t
        count: cython.Py_ssize_t = poses.shape[0]
        beams: cython.Py_ssize_t = points.shape[0]
        rows: cython.int = self._terms.shape[0]
        columns: cython.int = self._terms.shape[1]
        scale: cython.double = 1.0 / self._cell
        for n in range(count):
            c: cython.double = cos(poses[n, 2]) * scale
            s: cython.double = sin(poses[n, 2]) * scale
            x0: cython.double = (poses[n, 0] - self._x0) * scale + 1.0
            y0: cython.double = (poses[n, 1] - self._y0) * scale + 1.0
            for i in range(beams):
                column: cython.int = cython.cast(
                    cython.int, x0 + c * points[i, 0] - s * points[i, 1]
                )
                row: cython.int = cython.cast(cython.int, y0 + s * points[i, 0] + c * points[i, 1])
                if 0 <= column < columns and 0 <= row < rows and self._terms[row, column] > least:
                    result[i] += 1.0

    @cython.cfunc
    @cython.exceptval(check=False)
    def _score(
        self,
        poses: cython.double[:, ::1],
        points: cython.double[:, ::1],
        first: cython.double,
        result: cython.double[::1],
    ) -> cython.void:
        n: cython.Py_ssize_t
        i: cython.Py_ssize_t
        count: cython.Py_ssize_t = poses.shape[0]
        beams: cython.Py_ssize_t = points.shape[0]
        rows: cython.int = self._terms.shape[0]
        columns: cython.int = self._terms.shape[1]
        scale: cython.double = 1.0 / self._cell
        for n in range(count):
            # One cell to the left and below is the rim; a cast rounds down what is not negative.
            c: cython.double = cos(poses[n, 2]) * scale
            s: cython.double = sin(poses[n, 2]) * scale
            x0: cython.double = (poses[n, 0] - self._x0) * scale + 1.0
            y0: cython.double = (poses[n, 1] - self._y0) * scale + 1.0
            total: cython.double = first
            for i in range(beams):
                x: cython.double = x0 + c * points[i, 0] - s * points[i, 1]
                y: cython.double = y0 + s * points[i, 0] + c * points[i, 1]
                column: cython.int = cython.cast(cython.int, x)
                row: cython.int = cython.cast(cython.int, y)
                if 0 <= column < columns and 0 <= row < rows:
                    total += self._terms[row, column]
                else:
                    total += self._outside
            result[n] = total


@cython.cclass
class BeamModel:
    """How well ranges fit those that a ray on the map would have.

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
        """1 plus the sum of cubes of beams' probabilities, at each pose, shape (n,).

        Args:
            poses: x, y [m] and heading [rad] of the laser, shape (n, 3).
            beams: Ranges [m] and angles in the laser's frame [rad], shape (m, 2).
            most: Greatest range [m].
        """
        result = np.empty(len(poses))
        self._score(poses, beams, most, result)
        return result

    def range_at(self, x: float, y: float, heading: float, most: float) -> float:
        """How far a ray goes on the map [m]."""
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
        """Go from cell to cell along a ray (J. Amanatides and A. Woo, 1987)."""
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
