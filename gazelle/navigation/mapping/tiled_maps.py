"""Maps of many particles, in tiles that they share until one of them writes.

Cells hold how often beams passed and ended there, and where on average they ended. Scans are matched
to them as ``gmapping`` does it: G. Grisetti, C. Stachniss and W. Burgard, "Improved techniques for
grid mapping with Rao-Blackwellized particle filters", 2007.
"""

# mypy: disallow-untyped-decorators=False

import cython
import numpy as np
from cython.cimports.gazelle.native.elementary import cos, sin
from cython.cimports.libc.math import exp, floor

from gazelle.array_types import Floats, Floats32, Indices

SIDE = 32
"""Cells along a side of a tile."""


@cython.cclass
class TiledMaps:
    """Maps of some particles.

    Args:
        count: Of particles.
        rows: Of tiles.
        columns: Of tiles.
        origin: Of the lower left corner (x, y) [m].
        resolution: Side of a cell [m].
        sigma: Of ends of beams about their mean [m²], as gmapping's ``sigma``.
        spread: Of the likelihood [m²], as ``lsigma``.
        kernel: Cells around an end that are looked at.
    """

    _tables: cython.int[:, ::1]
    _pool: cython.float[:, ::1]
    _users: cython.int[::1]
    _used: cython.int
    _rows: cython.int
    _columns: cython.int
    _x0: cython.double
    _y0: cython.double
    _cell: cython.double
    _sigma: cython.double
    _spread: cython.double
    _kernel: cython.int
    _likelihood: cython.double

    def __init__(
        self,
        count: int,
        rows: int,
        columns: int,
        origin: tuple[float, float],
        resolution: float,
        sigma: float,
        spread: float,
        kernel: int,
    ) -> None:
        self._rows, self._columns = rows, columns
        self._x0, self._y0, self._cell = origin[0], origin[1], resolution
        self._sigma, self._spread, self._kernel = sigma, spread, kernel
        self._tables = np.full((count, rows * columns), -1, np.int32)
        self._pool = np.zeros((64, 1024 * 4), np.float32)
        self._users = np.zeros(64, np.int32)
        self._used = 0
        self._likelihood = 0.0

    def copy_particles(self, chosen: Indices) -> None:
        """Let each particle have the map of another, shape (count,)."""
        tables = np.asarray(self._tables)[chosen]
        users = np.bincount(tables[tables >= 0], minlength=self._used)
        # What nobody uses any more is left out.
        kept = np.flatnonzero(users > 0)
        place = np.full(self._used + 1, -1, np.int32)
        place[kept] = np.arange(len(kept), dtype=np.int32)
        self._tables = np.ascontiguousarray(place[tables])
        pool = np.asarray(self._pool)
        pool[: len(kept)] = pool[kept]
        counts = np.asarray(self._users)
        counts[: len(kept)] = users[kept]
        self._used = len(kept)

    def cells(self, particle: int) -> Floats32:
        """Sums of x and of y of ends [m], number of ends, and of visits; shape (4, rows, columns)."""
        table = np.asarray(self._tables)[particle]
        whole = np.zeros((self._rows * SIDE, self._columns * SIDE, 4), np.float32)
        pool = np.asarray(self._pool)
        for n in np.flatnonzero(table >= 0).tolist():
            row, column = n // self._columns * SIDE, n % self._columns * SIDE
            tile = pool[table[n]].reshape(SIDE, SIDE, 4)
            whole[row : row + SIDE, column : column + SIDE] = tile
        return np.ascontiguousarray(whole.transpose(2, 0, 1))

    def match(
        self,
        particle: int,
        pose: Floats,
        beams: Floats,
        step: float,
        turn: float,
        rounds: int,
    ) -> tuple[float, float]:
        """Move a pose to where a scan fits its map best, by hill climbing.

        Args:
            particle: Which.
            pose: x, y [m] and heading [rad] of the laser, changed in place, shape (3,).
            beams: x and y of ends, in the laser's frame [m], shape (n, 2).
            step: First step [m].
            turn: First turn [rad].
            rounds: How often steps are halved.

        Returns:
            How many beams fit, each up to 1, and the logarithm of the likelihood.
        """
        best = self._climb(particle, pose, beams, step, turn, rounds)
        self._score(particle, pose[0], pose[1], pose[2], beams)
        return best, self._likelihood

    @cython.cfunc
    @cython.exceptval(check=False)
    def _climb(
        self,
        particle: cython.int,
        pose: cython.double[::1],
        beams: cython.double[:, ::1],
        step: cython.double,
        turn: cython.double,
        rounds: cython.int,
    ) -> cython.double:
        x: cython.double = pose[0]
        y: cython.double = pose[1]
        heading: cython.double = pose[2]
        current: cython.double = self._score(particle, x, y, heading, beams)
        best: cython.double = -1.0
        halved: cython.int = 0
        while current > best or halved < rounds:
            if best >= current:
                halved += 1
                step *= 0.5
                turn *= 0.5
            best = current
            better_x: cython.double = x
            better_y: cython.double = y
            better_heading: cython.double = heading
            move: cython.int
            for move in range(6):
                dx: cython.double = step if move == 0 else -step if move == 1 else 0.0
                dy: cython.double = step if move == 2 else -step if move == 3 else 0.0
                dh: cython.double = turn if move == 4 else -turn if move == 5 else 0.0
                score: cython.double = self._score(particle, x + dx, y + dy, heading + dh, beams)
                if score > current:
                    current = score
                    better_x, better_y, better_heading = x + dx, y + dy, heading + dh
            x, y, heading = better_x, better_y, better_heading
        pose[0], pose[1], pose[2] = x, y, heading
        return current

    @cython.cfunc
    @cython.exceptval(check=False)
    def _score(
        self,
        particle: cython.int,
        x: cython.double,
        y: cython.double,
        heading: cython.double,
        beams: cython.double[:, ::1],
    ) -> cython.double:
        """How well ends of beams fit; the likelihood is left in an attribute."""
        c: cython.double = cos(heading)
        s: cython.double = sin(heading)
        total: cython.double = 0.0
        likelihood: cython.double = 0.0
        n: cython.Py_ssize_t
        i: cython.int
        j: cython.int
        count: cython.Py_ssize_t = beams.shape[0]
        kernel: cython.int = self._kernel
        for n in range(count):
            bx: cython.double = c * beams[n, 0] - s * beams[n, 1]
            by: cython.double = s * beams[n, 0] + c * beams[n, 1]
            px: cython.double = x + bx
            py: cython.double = y + by
            column: cython.int = cython.cast(cython.int, floor((px - self._x0) / self._cell))
            row: cython.int = cython.cast(cython.int, floor((py - self._y0) / self._cell))
            # One cell towards the laser, which has to be free.
            far: cython.double = (bx * bx + by * by) ** 0.5
            back_x: cython.int = cython.cast(cython.int, floor(0.5 - 1.4 * bx / far))
            back_y: cython.int = cython.cast(cython.int, floor(0.5 - 1.4 * by / far))
            nearest: cython.double = -1.0
            for i in range(-kernel, kernel + 1):
                for j in range(-kernel, kernel + 1):
                    away: cython.double = self._distance(
                        particle, column + i, row + j, back_x, back_y, px, py
                    )
                    if away >= 0.0 and (nearest < 0.0 or away < nearest):
                        nearest = away
            if nearest >= 0.0:
                total += exp(-nearest / self._sigma)
                likelihood -= nearest / self._spread
            else:
                likelihood -= 0.5 / self._spread
        self._likelihood = likelihood
        return total

    @cython.cfunc
    @cython.exceptval(check=False)
    def _distance(
        self,
        particle: cython.int,
        column: cython.int,
        row: cython.int,
        back_x: cython.int,
        back_y: cython.int,
        px: cython.double,
        py: cython.double,
    ) -> cython.double:
        """Squared distance from a place to a full cell's mean; -1 if it is not full, or no surface."""
        at: cython.Py_ssize_t = self._find(particle, column, row)
        if at < 0:
            return -1.0
        tile: cython.Py_ssize_t = at // 4096
        place: cython.Py_ssize_t = at % 4096
        hits: cython.float = self._pool[tile, place + 2]
        if hits <= 0.1 * self._pool[tile, place + 3]:
            return -1.0
        free: cython.Py_ssize_t = self._find(particle, column + back_x, row + back_y)
        if free >= 0:
            behind: cython.Py_ssize_t = free // 4096
            spot: cython.Py_ssize_t = free % 4096
            if self._pool[behind, spot + 2] > 0.1 * self._pool[behind, spot + 3]:
                return -1.0
        dx: cython.double = px - self._pool[tile, place] / hits
        dy: cython.double = py - self._pool[tile, place + 1] / hits
        return dx * dx + dy * dy

    @cython.cfunc
    @cython.exceptval(check=False)
    def _find(self, particle: cython.int, column: cython.int, row: cython.int) -> cython.Py_ssize_t:
        """Where a cell is in the pool; -1 if nothing is known there."""
        if column < 0 or row < 0 or column >= self._columns * 32 or row >= self._rows * 32:
            return -1
        tile: cython.int = self._tables[particle, row // 32 * self._columns + column // 32]
        if tile < 0:
            return -1
        return cython.cast(cython.Py_ssize_t, tile) * 4096 + ((row % 32) * 32 + column % 32) * 4

    # Writing ------------------------------------------------------------------------------

    def register(self, particle: int, pose: Floats, beams: Floats, most: float) -> None:
        """Draw a scan onto a particle's map.

        Args:
            particle: Which.
            pose: x, y [m] and heading [rad] of the laser, shape (3,).
            beams: x and y of ends, in the laser's frame [m], shape (n, 2).
            most: Farther ends are cut off there, and only what is before them is drawn [m].
        """
        needed = (int(2.0 * most / (self._cell * SIDE)) + 3) ** 2
        self._make_room(needed)
        self._draw(particle, pose, beams, most)

    def _make_room(self, needed: int) -> None:
        """Have so many unused tiles."""
        capacity = self._pool.shape[0]
        if self._used + needed > capacity:
            more = max(capacity, needed)
            self._pool = np.vstack(
                (np.asarray(self._pool), np.zeros((more, SIDE * SIDE * 4), np.float32))
            )
            self._users = np.append(np.asarray(self._users), np.zeros(more, np.int32))

    @cython.cfunc
    @cython.exceptval(check=False)
    def _draw(
        self,
        particle: cython.int,
        pose: cython.double[::1],
        beams: cython.double[:, ::1],
        most: cython.double,
    ) -> cython.void:
        c: cython.double = cos(pose[2])
        s: cython.double = sin(pose[2])
        n: cython.Py_ssize_t
        count: cython.Py_ssize_t = beams.shape[0]
        column: cython.int = cython.cast(cython.int, floor((pose[0] - self._x0) / self._cell))
        row: cython.int = cython.cast(cython.int, floor((pose[1] - self._y0) / self._cell))
        for n in range(count):
            bx: cython.double = c * beams[n, 0] - s * beams[n, 1]
            by: cython.double = s * beams[n, 0] + c * beams[n, 1]
            far: cython.double = (bx * bx + by * by) ** 0.5
            hit: cython.bint = far < most
            if not hit:
                bx, by = bx * most / far, by * most / far
            x: cython.double = pose[0] + bx
            y: cython.double = pose[1] + by
            end_x: cython.int = cython.cast(cython.int, floor((x - self._x0) / self._cell))
            end_y: cython.int = cython.cast(cython.int, floor((y - self._y0) / self._cell))
            self._line(particle, column, row, end_x, end_y)
            if hit:
                self._visit(particle, end_x, end_y, True, x, y)

    @cython.cfunc
    @cython.exceptval(check=False)
    def _line(
        self,
        particle: cython.int,
        x: cython.int,
        y: cython.int,
        end_x: cython.int,
        end_y: cython.int,
    ) -> cython.void:
        """Visit the cells before the end."""
        dx: cython.int = end_x - x
        dy: cython.int = end_y - y
        step_x: cython.int = 1 if dx >= 0 else -1
        step_y: cython.int = 1 if dy >= 0 else -1
        dx, dy = dx * step_x, dy * step_y
        long: cython.int = max(dy, dx)
        error: cython.int = long // 2
        for _ in range(long):
            self._visit(particle, x, y, False, 0.0, 0.0)
            if dx > dy:
                x += step_x
                error -= dy
                if error < 0:
                    y += step_y
                    error += dx
            else:
                y += step_y
                error -= dx
                if error < 0:
                    x += step_x
                    error += dy

    @cython.cfunc
    @cython.exceptval(check=False)
    def _visit(
        self,
        particle: cython.int,
        column: cython.int,
        row: cython.int,
        hit: cython.bint,
        x: cython.double,
        y: cython.double,
    ) -> cython.void:
        if column < 0 or row < 0 or column >= self._columns * 32 or row >= self._rows * 32:
            return
        n: cython.int = row // 32 * self._columns + column // 32
        tile: cython.int = self._tables[particle, n]
        if tile < 0 or self._users[tile] > 1:
            tile = self._own(particle, n, tile)
            if tile < 0:
                return
        place: cython.Py_ssize_t = ((row % 32) * 32 + column % 32) * 4
        self._pool[tile, place + 3] += 1.0
        if hit:
            self._pool[tile, place] += x
            self._pool[tile, place + 1] += y
            self._pool[tile, place + 2] += 1.0

    @cython.cfunc
    @cython.exceptval(check=False)
    def _own(self, particle: cython.int, n: cython.int, shared: cython.int) -> cython.int:
        """Give a particle a tile of its own, with what is in a shared one."""
        tile: cython.int = self._used
        if tile >= self._pool.shape[0]:
            return -1
        self._used += 1
        self._users[tile] = 1
        self._tables[particle, n] = tile
        i: cython.int
        for i in range(4096):
            self._pool[tile, i] = self._pool[shared, i] if shared >= 0 else 0.0
        if shared >= 0:
            self._users[shared] -= 1
        return tile
