"""Potential of a grid: the cost from one cell to all others, and descent from any of them.

The potential obeys the eikonal equation: its slope is the traversal cost of the cell. Method: each cell from
its lower neighbours along x and y (J. Sethian, "A fast marching level set method", 1996), cells in
order of blocks of the least cost (K. Konolige, "A gradient method for realtime robot control",
2000), which is what ``navfn`` does, too.
"""

# mypy: disallow-untyped-decorators=False

import cython
import numpy as np
from cython.cimports.libc.math import fabs, sqrt

from gazelle.array_types import Floats, Floats32
from gazelle.navigation.planners.astar import search

NOT_REACHED = 1e10
"""The potential of cells that cannot be reached, or have not been."""

_FAR = cython.declare(cython.float, NOT_REACHED)


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
    _cost: cython.float[::1]
    _value: cython.float[::1]
    _waiting: cython.uchar[::1]
    _lists: cython.int[:, ::1]

    def __init__(self, rows: int, columns: int) -> None:
        self._rows, self._columns = rows, columns
        size = rows * columns
        self._cost = np.zeros(size, np.float32)
        self._value = np.full(size, NOT_REACHED, np.float32)
        self._waiting = np.zeros(size, np.uint8)
        self._lists = np.zeros((3, size + 4), np.int32)

    @property
    def values(self) -> Floats32:
        """The potentials, shape (rows, columns); a view."""
        return np.asarray(self._value).reshape(self._rows, self._columns)

    def spread(
        self,
        traversal_costs: Floats32,
        source: tuple[int, int],
        target: tuple[int, int] | None,
        step: float,
        quadratic: int = 1,
    ) -> bool:
        """Find the potentials, as far as until the target has its own.

        Args:
            traversal_costs: To cross each cell, 0 where it is closed, shape (rows, columns).
            source: Column and row where the potential is 0.
            target: Column and row that it must reach; None for all cells.
            step: The least traversal cost of a cell.
            quadratic: 1 to solve with both axes; else only along the cheaper one.

        Returns:
            Whether the target was reached; with None, True.
        """
        self._clear(traversal_costs)
        np.asarray(self._waiting).fill(0)
        first: cython.int = source[1] * self._columns + source[0]
        last: cython.int = -1 if target is None else target[1] * self._columns + target[0]
        self._run(first, last, step, quadratic)
        return bool(last < 0 or self._value[last] < _FAR)

    def search(
        self,
        traversal_costs: Floats32,
        source: tuple[int, int],
        target: tuple[int, int],
        neutral: float,
        quadratic: int = 1,
    ) -> bool:
        """Find the potentials of cells towards a target, as few as A* needs.

        Args:
            traversal_costs: As for `spread`.
            source: Column and row where the potential is 0.
            target: Column and row that it must reach.
            neutral: Price of a cell in the heuristic.
            quadratic: As for `spread`.

        Returns:
            Whether the target was reached; if not, all cells that can be reached have a potential.
        """
        self._clear(traversal_costs)
        ends = source[1] * self._columns + source[0], target[1] * self._columns + target[0]
        cost, value = np.asarray(self._cost), np.asarray(self._value)
        return search(cost, value, self._columns, ends, neutral, quadratic)

    def _clear(self, traversal_costs: Floats32) -> None:
        """Set the traversal costs, and all potentials to `NOT_REACHED`."""
        cost = np.asarray(self._cost).reshape(self._rows, self._columns)
        # No way through a closed cell is cheaper than none, so that it needs no question of its own.
        np.copyto(cost, np.float32(np.inf))
        inner = slice(1, -1), slice(1, -1)
        np.copyto(cost[inner], traversal_costs[inner], where=traversal_costs[inner] > 0.0)
        np.asarray(self._value).fill(NOT_REACHED)

    @cython.cfunc
    @cython.exceptval(check=False)
    def _run(
        self, first: cython.int, last: cython.int, step: cython.float, quadratic: cython.bint
    ) -> cython.void:
        # Local, as they then stay in registers: a byte that is written could be part of any attribute.
        value: cython.float[::1] = self._value
        cost: cython.float[::1] = self._cost
        waiting: cython.uchar[::1] = self._waiting
        lists: cython.int[:, ::1] = self._lists
        columns: cython.int = self._columns
        i: cython.int
        count: cython.int
        # Which lists have the cells of the next round, of the next block, and of this round; how many.
        use = cython.declare(cython.int[3])
        counts = cython.declare(cython.int[2])
        use[0], use[1], use[2] = 0, 1, 2
        counts[0] = counts[1] = 0
        threshold: cython.float = step
        value[first] = 0.0
        counts[0] = self._begin(first, columns, cost, waiting, lists)
        while True:
            if counts[0] == 0:
                if counts[1] == 0:
                    return
                # A block is over when all up to its threshold is settled; so is then the target.
                if last >= 0 and value[last] < threshold:
                    return
                threshold += 16.0 * step
                use[0], use[1] = use[1], use[0]
                counts[0], counts[1] = counts[1], 0
            use[0], use[2] = use[2], use[0]
            count, counts[0] = counts[0], 0
            for i in range(count):
                waiting[lists[use[2], i]] = 0
            for i in range(count):
                n: cython.int = lists[use[2], i]
                if self._settle(n, columns, quadratic, value, cost):
                    self._push_around(
                        n, columns, threshold, value, cost, waiting, lists, use, counts
                    )

    @cython.cfunc
    @cython.exceptval(check=False)
    def _begin(
        self,
        first: cython.int,
        columns: cython.int,
        cost: cython.float[::1],
        waiting: cython.uchar[::1],
        lists: cython.int[:, ::1],
    ) -> cython.int:
        """Queue the neighbours of the source; returns their number."""
        side: cython.int
        count: cython.int = 0
        for side in range(4):
            move: cython.int = 1 if side < 2 else columns
            other: cython.int = first + (move if side % 2 else -move)
            # The source may be on the outermost row, which has none on its other side.
            if other >= 0 and other < cost.shape[0] and cost[other] < _FAR:
                lists[0, count] = other
                waiting[other] = 1
                count += 1
        return count

    @cython.cfunc
    @cython.inline
    @cython.exceptval(check=False)
    def _settle(
        self,
        n: cython.int,
        columns: cython.int,
        quadratic: cython.bint,
        value: cython.float[::1],
        cost: cython.float[::1],
    ) -> cython.bint:
        """Lower a cell's potential to that of its neighbours; returns whether it is lower now."""
        a: cython.float = min(value[n + 1], value[n - 1])
        b: cython.float = min(value[n - columns], value[n + columns])
        own: cython.float = cost[n]
        apart: cython.float = fabs(a - b)
        found: cython.float
        if not quadratic or apart >= own:
            found = min(b, a) + own
        else:
            found = 0.5 * (a + b + sqrt(2.0 * own * own - apart * apart))
        # Less than that is no better way but rounding.
        if found >= value[n] - 1e-3:
            return False
        value[n] = found
        return True

    @cython.cfunc
    @cython.inline
    @cython.exceptval(check=False)
    def _push_around(
        self,
        n: cython.int,
        columns: cython.int,
        threshold: cython.float,
        value: cython.float[::1],
        cost: cython.float[::1],
        waiting: cython.uchar[::1],
        lists: cython.int[:, ::1],
        use: cython.p_int,
        counts: cython.p_int,
    ) -> cython.void:
        """Queue the neighbours of a cell, in this block or the next.

        Whether one needs it is a toss, which a processor cannot guess: so each is written to the end of the list,
        and the end moves on or not.
        """
        own: cython.float = value[n]
        which: cython.int = 0 if own < threshold else 1
        line: cython.int = use[which]
        count: cython.int = counts[which]
        share: cython.float = 0.7
        side: cython.int
        for side in range(4):
            move: cython.int = 1 if side < 2 else columns
            other: cython.int = n + (move if side % 2 else -move)
            wanted: cython.int = value[other] > own + share * cost[other]
            wanted &= waiting[other] ^ 1
            lists[line, count] = other
            waiting[other] |= wanted
            count += wanted
        counts[which] = count

    def way_down(self, start: tuple[int, int], source: tuple[int, int], grid: int = 0) -> Floats:
        """Return the way of steepest descent from a cell to the source.

        Args:
            start: Column and row.
            source: Cell with the potential 0.
            grid: 1 to go from cell to cell; else in steps of half a cell along the gradient.

        Returns:
            Columns and rows, of cells' middles ints, shape (n, 2); empty if it leads nowhere.
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
            before = value + 0.25 * self._cost[n]
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
        """Return whether all cells around one have a potential, so that its slope is defined."""
        row: cython.int
        column: cython.int
        for row in range(-1, 2):
            for column in range(-1, 2):
                if self._value[n + row * self._columns + column] >= _FAR:
                    return False
        return True

    @cython.cfunc
    @cython.exceptval(check=False)
    def _between(self, x: cython.double, y: cython.double, axis: cython.int) -> cython.double:
        """Return the slope at a place between the middles of four cells."""
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
        """Return one part of the direction of the slope in a cell."""
        gx: cython.double = self._slope(n, 0)
        gy: cython.double = self._slope(n, 1)
        size: cython.double = sqrt(gx * gx + gy * gy)
        if size <= 0.0:
            return 0.0
        return (gx if axis == 0 else gy) / size

    @cython.cfunc
    @cython.exceptval(check=False)
    def _slope(self, n: cython.int, axis: cython.int) -> cython.double:
        """Return the slope of the potential in a cell, from the neighbours that have one."""
        move: cython.int = 1 if axis == 0 else self._columns
        if n - move < 0 or n + move >= self._rows * self._columns:
            return 0.0
        here: cython.double = self._value[n]
        low: cython.double = self._value[n - move]
        high: cython.double = self._value[n + move]
        if here >= _FAR:
            return 0.0
        if low >= _FAR and high >= _FAR:
            return 0.0
        # Downhill only a neighbour that is lower counts: a ridge has no slope of its own.
        if low < here and (low <= high or high >= _FAR):
            return here - low
        if high < here:
            return high - here
        return 0.0

    @cython.cfunc
    @cython.exceptval(check=False)
    def _lowest(self, n: cython.int) -> cython.int:
        """Return the lowest of a cell and its eight neighbours."""
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
