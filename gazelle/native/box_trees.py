"""Binary trees of boxes, in which a search for what touches a box meets few others.

A box that lies anywhere meets another one in proportion to the other's surface. So boxes are
split in two where surface times number, added up over both parts, is least (the surface area
heuristic of MacDonald and Booth 1990) rather than into equal numbers along the longest side.
"""

# mypy: disallow-untyped-decorators=False

import cython
import numpy as np

from gazelle.array_types import Floats, Ints32

# What extends further is endless, as planes are.
_FAR = cython.declare(cython.double, 1e9)

# From this number of levels on parts have equal numbers: boxes that lie within each other could be split
# off one by one.
_DEEP = cython.declare(cython.int, 48)


@cython.final
@cython.cclass
class BoxTree:
    """A tree of boxes, its nodes numbered from the root, each before all that is below it.

    Args:
        boxes: Centres and half sizes, shape (n, 6).

    Raises:
        ValueError: There is none.
    """

    _boxes: cython.double[:, ::1]
    _orders: cython.int[:, ::1]
    _spare: cython.int[::1]
    _left: cython.uchar[::1]
    _surfaces: cython.double[::1]
    _bounds: cython.double[:, ::1]
    _children: cython.int[:, ::1]
    _leaf: cython.int[::1]
    _depth: cython.int[::1]
    _low: cython.double[::1]
    _high: cython.double[::1]
    _cost: cython.double
    _count: cython.int

    def __init__(self, boxes: Floats) -> None:
        size = len(boxes)
        if size < 1:
            raise ValueError("a box tree needs at least one box")
        self._boxes = np.array(boxes, np.float64, order="C")
        # By their centres along each axis; within a node they remain in this order.
        orders = np.argsort(boxes[:, :3], axis=0, kind="stable")
        self._orders = np.array(orders.T, np.int32, order="C")
        self._spare, self._left = np.zeros(size, np.int32), np.zeros(size, np.uint8)
        self._surfaces = np.zeros(size)
        self._low, self._high = np.zeros((2, 3))
        self._bounds = np.zeros((2 * size - 1, 6))
        self._children = np.full((2 * size - 1, 2), -1, np.int32)
        self._leaf, self._depth = np.full((2, 2 * size - 1), -1, np.int32)
        self._count = 0
        count: cython.int = size
        with cython.nogil:
            self._grow(0, count, 0)

    @property
    def bounds(self) -> Floats:
        """Centre and half sizes of all below each node, shape (2 n - 1, 6)."""
        return np.asarray(self._bounds)

    @property
    def children(self) -> Ints32:
        """The two nodes below each, -1 for leaves, shape (2 n - 1, 2)."""
        return np.asarray(self._children)

    @property
    def leaf(self) -> Ints32:
        """Index of each leaf's box, -1 for other nodes, shape (2 n - 1,)."""
        return np.asarray(self._leaf)

    @property
    def depth(self) -> Ints32:
        """Number of nodes above each, shape (2 n - 1,)."""
        return np.asarray(self._depth)

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def _grow(self, first: cython.int, last: cython.int, level: cython.int) -> cython.int:
        """Add the node of some boxes, and all below it; returns its number."""
        node: cython.int = self._count
        self._count += 1
        self._depth[node] = level
        self._enclose(first, last, node)
        if last - first == 1:
            self._leaf[node] = self._orders[0, first]
        else:
            middle: cython.int = self._split(first, last, level)
            self._children[node, 0] = self._grow(first, middle, level + 1)
            self._children[node, 1] = self._grow(middle, last, level + 1)
        return node

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def _enclose(self, first: cython.int, last: cython.int, node: cython.int) -> cython.void:
        """Write the box around some boxes."""
        place: cython.int
        side: cython.int
        box: cython.int = self._orders[0, first]
        if last - first == 1:
            for side in range(6):
                self._bounds[node, side] = self._boxes[box, side]
            return
        self._begin(0, first)
        for place in range(first, last):
            self._with(0, place)
        for side in range(3):
            self._bounds[node, side] = 0.5 * (self._low[side] + self._high[side])
            self._bounds[node, 3 + side] = 0.5 * (self._high[side] - self._low[side])

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def _split(self, first: cython.int, last: cython.int, level: cython.int) -> cython.int:
        """Partition boxes into left and right; returns where the right part starts."""
        axis: cython.int
        middle: cython.int = self._endless(first, last)
        if middle > first:
            return middle
        chosen: cython.int = 0
        least: cython.double = -1.0
        for axis in range(3):
            place: cython.int = self._cheapest(first, last, axis, level)
            if least < 0.0 or self._cost < least:
                least, chosen, middle = self._cost, axis, place
        for place in range(first, last):
            self._left[self._orders[chosen, place]] = place < middle
        self._divide(first, last)
        return middle

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def _endless(self, first: cython.int, last: cython.int) -> cython.int:
        """Move endless boxes to the left.

        Returns where the others start, ``first`` if all are alike.
        """
        place: cython.int
        box: cython.int
        found: cython.int = 0
        for place in range(first, last):
            box = self._orders[0, place]
            far: cython.bint = (
                max(self._boxes[box, 3], self._boxes[box, 4], self._boxes[box, 5]) > _FAR
            )
            self._left[box] = far
            found += far
        if found == 0 or found == last - first:
            return first
        self._divide(first, last)
        return first + found

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def _cheapest(
        self, first: cython.int, last: cython.int, axis: cython.int, level: cython.int
    ) -> cython.int:
        """Return the best split of boxes in their order along an axis; store its ``_cost``."""
        place: cython.int
        middle: cython.int = (first + last) // 2
        self._begin(axis, last - 1)
        for place in range(last - 1, first, -1):
            self._surfaces[place] = self._with(axis, place) * (last - place)
        self._begin(axis, first)
        self._cost = -1.0
        for place in range(first + 1, last):
            cost: cython.double = (
                self._with(axis, place - 1) * (place - first) + self._surfaces[place]
            )
            if level > _DEEP and place != (first + last) // 2:
                continue
            # Of what costs the same, halves: boxes at the same place.
            nearer: cython.bint = abs(2 * place - first - last) < abs(2 * middle - first - last)
            if self._cost < 0.0 or cost < self._cost or (cost == self._cost and nearer):
                self._cost, middle = cost, place
        return middle

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def _begin(self, axis: cython.int, place: cython.int) -> cython.void:
        """Reset the growing box to empty at a place."""
        side: cython.int
        box: cython.int = self._orders[axis, place]
        for side in range(3):
            self._low[side] = self._high[side] = self._boxes[box, side]

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def _with(self, axis: cython.int, place: cython.int) -> cython.double:
        """Extend the growing box by the one at a place; returns half its surface."""
        side: cython.int
        box: cython.int = self._orders[axis, place]
        for side in range(3):
            self._low[side] = min(
                self._low[side], self._boxes[box, side] - self._boxes[box, 3 + side]
            )
            self._high[side] = max(
                self._high[side], self._boxes[box, side] + self._boxes[box, 3 + side]
            )
        x: cython.double = self._high[0] - self._low[0]
        y: cython.double = self._high[1] - self._low[1]
        z: cython.double = self._high[2] - self._low[2]
        return x * y + y * z + z * x

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def _divide(self, first: cython.int, last: cython.int) -> cython.void:
        """Move the boxes of the left part to the left, in all three orders."""
        axis: cython.int
        place: cython.int
        for axis in range(3):
            left: cython.int = first
            right: cython.int = 0
            for place in range(first, last):
                box: cython.int = self._orders[axis, place]
                if self._left[box]:
                    self._orders[axis, left] = box
                    left += 1
                else:
                    self._spare[right] = box
                    right += 1
            for place in range(right):
                self._orders[axis, left + place] = self._spare[place]
