"""How dear it is to get from one cell to all others, and the way down from any of them.

The potential obeys the eikonal equation: its slope is the price of the cell. Method: each cell from
its lower neighbours along x and y (J. Sethian, "A fast marching level set method", 1996), cells in
order of blocks of the least price (K. Konolige, "A gradient method for realtime robot control",
2000), which is what ``navfn`` does, too.
"""

# mypy: disallow-untyped-decorators=False

import cython
import numpy as np
from cython.cimports.libc.math import sqrt

from gazelle.array_types import Floats, Floats32

NOT_REACHED = 1e10
"""The potential of cells that cannot be reached, or have not been."""


@cython.cclass
class PotentialField:
    """The potential of all cells of a grid.

    The outermost cells are closed.

    Args:
        rows: Of the grid.
        columns: Of the grid.
    """

    _columns: cython.int
    _rows: cython.int
    _price: cython.float[::1]
    _value: cython.float[::1]
    _waiting: cython.uchar[::1]
    _lists: cython.int[:, ::1]
    _next_count: cython.int
    _over_count: cython.int
    _next: cython.int
    _over: cython.int
    _threshold: cython.float

    def __init__(self, rows: int, columns: int) -> None:
        self._rows, self._columns = rows, columns
        size = rows * columns
        self._price = np.zeros(size, np.float32)
        self._value = np.full(size, NOT_REACHED, np.float32)
        self._waiting = np.zeros(size, np.uint8)
        self._lists = np.zeros((3, size + 4), np.int32)

    @property
    def values(self) -> Floats32:
        """The potentials, shape (rows, columns); a view."""
        return np.asarray(self._value).reshape(self._rows, self._columns)

    def spread(
        self,
        prices: Floats32,
        source: tuple[int, int],
        target: tuple[int, int] | None,
        step: float,
        quadratic: int = 1,
    ) -> bool:
        """Find the potentials, as far as until the target has its own.

        Args:
            prices: Of a cell's length in each cell, 0 where it is closed, shape (rows, columns).
            source: Column and row where the potential is 0.
            target: Column and row that it must reach; None for all cells.
            step: The least price of a cell.
            quadratic: 1 to solve with both axes; else only along the cheaper one.

        Returns:
            Whether the target was reached; with None, True.
        """
        np.asarray(self._price)[:] = prices.ravel()
        edges = np.asarray(self._price).reshape(self._rows, self._columns)
        edges[:: self._rows - 1] = edges[:, :: self._columns - 1] = 0.0
        np.asarray(self._value).fill(NOT_REACHED)
        np.asarray(self._waiting).fill(0)
        first: cython.int = source[1] * self._columns + source[0]
        last: cython.int = -1 if target is None else target[1] * self._columns + target[0]
        self._run(first, last, step, quadratic)
        return bool(last < 0 or self._value[last] < NOT_REACHED)

    @cython.cfunc
    @cython.exceptval(check=False)
    def _run(
        self, first: cython.int, last: cython.int, step: cython.float, quadratic: cython.bint
    ) -> cython.void:
        n: cython.int
        i: cython.int
        count: cython.int
        now: cython.int = 0
        self._next, self._over = 1, 2
        self._next_count = self._over_count = 0
        self._threshold = step
        self._value[first] = 0.0
        self._push(first + 1, 0.0)
        self._push(first - 1, 0.0)
        self._push(first + self._columns, 0.0)
        self._push(first - self._columns, 0.0)
        while True:
            if self._next_count == 0:
                if self._over_count == 0:
                    return
                # A block is over when all up to its threshold is settled; so is then the target.
                if last >= 0 and self._value[last] < self._threshold:
                    return
                self._threshold += 16.0 * step
                self._next, self._over = self._over, self._next
                self._next_count, self._over_count = self._over_count, 0
            now, self._next = self._next, now
            count, self._next_count = self._next_count, 0
            for i in range(count):
                self._waiting[self._lists[now, i]] = 0
            for i in range(count):
                n = self._lists[now, i]
                self._settle(n, quadratic)

    @cython.cfunc
    @cython.exceptval(check=False)
    def _settle(self, n: cython.int, quadratic: cython.bint) -> cython.void:
        """Lower a cell's potential to what its neighbours make of it, and tell them."""
        left: cython.float = self._value[n - 1]
        right: cython.float = self._value[n + 1]
        up: cython.float = self._value[n + self._columns]
        down: cython.float = self._value[n - self._columns]
        a: cython.float = min(right, left)
        b: cython.float = min(down, up)
        price: cython.float = self._price[n]
        low: cython.float = min(b, a)
        apart: cython.float = b - a if a < b else a - b
        value: cython.float
        if not quadratic or apart >= price:
            value = low + price
        else:
            value = 0.5 * (a + b + sqrt(2.0 * price * price - apart * apart))
        # Less than that is no better way but rounding.
        if value >= self._value[n] - 1e-3:
            return
        self._value[n] = value
        if left > value:
            self._push(n - 1, value)
        if right > value:
            self._push(n + 1, value)
        if up > value:
            self._push(n + self._columns, value)
        if down > value:
            self._push(n - self._columns, value)

    @cython.cfunc
    @cython.exceptval(check=False)
    def _push(self, n: cython.int, value: cython.float) -> cython.void:
        """Have a cell looked at, in this block or the next."""
        price: cython.float = self._price[n]
        if self._waiting[n] or price <= 0.0 or self._value[n] <= value + 0.7 * price:
            return
        self._waiting[n] = 1
        if value < self._threshold:
            self._lists[self._next, self._next_count] = n
            self._next_count += 1
        else:
            self._lists[self._over, self._over_count] = n
            self._over_count += 1

    def way_down(self, start: tuple[int, int], source: tuple[int, int], grid: int = 0) -> Floats:
        """The way of steepest descent from a cell to the source.

        Args:
            start: Column and row.
            source: Where the potential is 0.
            grid: 1 to go from cell to cell; else in steps of half a cell along the gradient.

        Returns:
            Columns and rows, of cells' middles whole numbers, shape (n, 2); empty if it leads nowhere.
        """
        room = 8 * (self._rows + self._columns) + self._rows * self._columns // 4
        points = np.empty((room, 2))
        count = self._descend(points, start[0], start[1], source[0], source[1], grid)
        return points[:count]

    @cython.cfunc
    @cython.exceptval(check=False)
    def _descend(
        self,
        points: cython.double[:, ::1],
        x: cython.double,
        y: cython.double,
        goal_x: cython.double,
        goal_y: cython.double,
        grid: cython.bint,
    ) -> cython.int:
        count: cython.int = 0
        room: cython.int = points.shape[0]
        size: cython.double
        gx: cython.double
        gy: cython.double
        value: cython.double
        before: cython.double = 1e30
        while count < room - 1:
            points[count, 0], points[count, 1] = x, y
            count += 1
            if (x - goal_x) * (x - goal_x) + (y - goal_y) * (y - goal_y) < 1.0:
                points[count, 0], points[count, 1] = goal_x, goal_y
                return count + 1
            column: cython.int = cython.cast(cython.int, x + 0.5)
            row: cython.int = cython.cast(cython.int, y + 0.5)
            n: cython.int = row * self._columns + column
            value = self._value[n]
            gx = gy = 0.0
            if not grid and value < before:
                gx, gy = self._slope(n, 0), self._slope(n, 1)
                if self._open(n):
                    gx, gy = self._between(x, y, 0), self._between(x, y, 1)
            size = sqrt(gx * gx + gy * gy)
            before = value + 0.25 * self._price[n]
            if size > 0.0:
                x -= 0.5 * gx / size
                y -= 0.5 * gy / size
                column, row = cython.cast(cython.int, x + 0.5), cython.cast(cython.int, y + 0.5)
                if self._value[row * self._columns + column] < before:
                    continue
                x, y = points[count - 1, 0], points[count - 1, 1]
            other: cython.int = self._lowest(n)
            if other == n:
                return 0
            x, y = other % self._columns, other // self._columns
            before = self._value[n]
        return 0

    @cython.cfunc
    @cython.exceptval(check=False)
    def _open(self, n: cython.int) -> cython.bint:
        """Whether all cells around one have a potential, so that slopes mean something."""
        row: cython.int
        column: cython.int
        for row in range(-1, 2):
            for column in range(-1, 2):
                if self._value[n + row * self._columns + column] >= NOT_REACHED:
                    return False
        return True

    @cython.cfunc
    @cython.exceptval(check=False)
    def _between(self, x: cython.double, y: cython.double, axis: cython.int) -> cython.double:
        """The slope at a place between the middles of four cells."""
        column: cython.int = cython.cast(cython.int, x)
        row: cython.int = cython.cast(cython.int, y)
        s: cython.double = x - column
        t: cython.double = y - row
        n: cython.int = row * self._columns + column
        low: cython.double = (1.0 - s) * self._unit(n, axis) + s * self._unit(n + 1, axis)
        above: cython.int = n + self._columns
        high: cython.double = (1.0 - s) * self._unit(above, axis) + s * self._unit(above + 1, axis)
        return (1.0 - t) * low + t * high

    @cython.cfunc
    @cython.exceptval(check=False)
    def _unit(self, n: cython.int, axis: cython.int) -> cython.double:
        """One part of the direction of the slope in a cell."""
        gx: cython.double = self._slope(n, 0)
        gy: cython.double = self._slope(n, 1)
        size: cython.double = sqrt(gx * gx + gy * gy)
        if size <= 0.0:
            return 0.0
        return (gx if axis == 0 else gy) / size

    @cython.cfunc
    @cython.exceptval(check=False)
    def _slope(self, n: cython.int, axis: cython.int) -> cython.double:
        """Of the potential in a cell, from the neighbours that have one."""
        move: cython.int = 1 if axis == 0 else self._columns
        if n - move < 0 or n + move >= self._rows * self._columns:
            return 0.0
        here: cython.double = self._value[n]
        low: cython.double = self._value[n - move]
        high: cython.double = self._value[n + move]
        if here >= NOT_REACHED:
            return 0.0
        if low >= NOT_REACHED and high >= NOT_REACHED:
            return 0.0
        # Downhill only a neighbour that is lower counts: a ridge has no slope of its own.
        if low < here and (low <= high or high >= NOT_REACHED):
            return here - low
        if high < here:
            return high - here
        return 0.0

    @cython.cfunc
    @cython.exceptval(check=False)
    def _lowest(self, n: cython.int) -> cython.int:
        """The lowest of a cell and its eight neighbours."""
        row: cython.int
        column: cython.int
        best: cython.int = n
        for row in range(-1, 2):
            for column in range(-1, 2):
                other: cython.int = n + row * self._columns + column
                if (
                    other >= 0
                    and other < self._rows * self._columns
                    and self._value[other] < self._value[best]
                ):
                    best = other
        return best
