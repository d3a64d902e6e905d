"""Maps of many particles, in tiles that they share until one of them writes.

Cells hold how often beams passed and ended there, and where on average they ended.
"""

# mypy: disallow-untyped-decorators=False

import cython
import numpy as np
from cython.cimports.gazelle.native.elementary import cos, sin
from cython.cimports.libc.math import floor

from gazelle.array_types import Floats, Floats32, Indices

SIDE = 32
"""Cells along a side of a tile."""


@cython.final
@cython.cclass
class TiledMaps:
    """Maps of some particles.

    Args:
        count: Of particles.
        rows: Of tiles.
        columns: Of tiles.
        origin: Of the lower left corner (x, y) [m].
        resolution: Side of a cell [m].
    """

    def __init__(
        self,
        count: int,
        rows: int,
        columns: int,
        origin: tuple[float, float],
        resolution: float,
    ) -> None:
        self._rows, self._columns = rows, columns
        self.x0, self.y0, self.cell = origin[0], origin[1], resolution
        self._tables = np.full((count, rows * columns), -1, np.int32)
        self.pool = np.zeros((64, 1024 * 4), np.float32)
        self._users = np.zeros(64, np.int32)
        self._used = 0

    def copy_particles(self, chosen: Indices) -> None:
        """Copy the map of another particle to each, shape (count,)."""
        tables = np.asarray(self._tables)[chosen]
        users = np.bincount(tables[tables >= 0], minlength=self._used)
        # What is not used any more is left out.
        kept = np.flatnonzero(users > 0)
        place = np.full(self._used + 1, -1, np.int32)
        place[kept] = np.arange(len(kept), dtype=np.int32)
        self._tables = np.ascontiguousarray(place[tables])
        pool = np.asarray(self.pool)
        pool[: len(kept)] = pool[kept]
        counts = np.asarray(self._users)
        counts[: len(kept)] = users[kept]
        self._used = len(kept)

    def cells(self, particle: int) -> Floats32:
        """Return sums of x and y of ends [m], numbers of ends and visits.

        Shape (4, rows, columns).
        """
        table = np.asarray(self._tables)[particle]
        whole = np.zeros((self._rows * SIDE, self._columns * SIDE, 4), np.float32)
        pool = np.asarray(self.pool)
        for n in np.flatnonzero(table >= 0).tolist():
            row, column = n // self._columns * SIDE, n % self._columns * SIDE
            tile = pool[table[n]].reshape(SIDE, SIDE, 4)
            whole[row : row + SIDE, column : column + SIDE] = tile
        return np.ascontiguousarray(whole.transpose(2, 0, 1))

    @cython.cfunc
    @cython.exceptval(check=False)
    def find(self, particle: cython.int, column: cython.int, row: cython.int) -> cython.Py_ssize_t:
        """Return the index of a cell in the pool; -1 if nothing is known there."""
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
            particle: Index of the particle.
            pose: x, y [m] and heading [rad] of the laser, shape (3,).
            beams: x and y of ends, in the laser's frame [m], shape (n, 2).
            most: Farther ends are cut off there, and only what is before them is drawn [m].
        """
        needed = (int(2.0 * most / (self.cell * SIDE)) + 3) ** 2
        self._make_room(needed)
        self._draw(particle, pose, beams, most)

    def _make_room(self, needed: int) -> None:
        """Allocate a given number of unused tiles."""
        capacity = self.pool.shape[0]
        if self._used + needed > capacity:
            more = max(capacity, needed)
            self.pool = np.vstack(
                (np.asarray(self.pool), np.zeros((more, SIDE * SIDE * 4), np.float32))
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
        column: cython.int = cython.cast(cython.int, floor((pose[0] - self.x0) / self.cell))
        row: cython.int = cython.cast(cython.int, floor((pose[1] - self.y0) / self.cell))
        for n in range(count):
            bx: cython.double = c * beams[n, 0] - s * beams[n, 1]
            by: cython.double = s * beams[n, 0] + c * beams[n, 1]
            far: cython.double = (bx * bx + by * by) ** 0.5
            hit: cython.bint = far < most
            if not hit:
                bx, by = bx * most / far, by * most / far
            x: cython.double = pose[0] + bx
            y: cython.double = pose[1] + by
            end_x: cython.int = cython.cast(cython.int, floor((x - self.x0) / self.cell))
            end_y: cython.int = cython.cast(cython.int, floor((y - self.y0) / self.cell))
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
        self.pool[tile, place + 3] += 1.0
        if hit:
            self.pool[tile, place] += x
            self.pool[tile, place + 1] += y
            self.pool[tile, place + 2] += 1.0

    @cython.cfunc
    @cython.exceptval(check=False)
    def _own(self, particle: cython.int, n: cython.int, shared: cython.int) -> cython.int:
        """Copy a shared tile to one of the particle's own."""
        tile: cython.int = self._used
        if tile >= self.pool.shape[0]:
            return -1
        self._used += 1
        self._users[tile] = 1
        self._tables[particle, n] = tile
        i: cython.int
        for i in range(4096):
            self.pool[tile, i] = self.pool[shared, i] if shared >= 0 else 0.0
        if shared >= 0:
            self._users[shared] -= 1
        return tile
