# cython: infer_types=True, annotation_typing=False
# mypy: disable-error-code="no-any-return"
"""Places in the air around a surface, and the test of hulls against them."""

from __future__ import annotations

import cython
import numpy as np
from cython.cimports.gazelle.geometry.integer_hull import HullBuilder

from gazelle.array_types import Floats, Indices

_CELLS = 24
"""Cells along the longest side of the grid that places are sorted into."""


@cython.final
@cython.cclass
class AirProbes:
    """Places that no hull may hold, sorted into the cells of a grid.

    Args:
        places: [m], shape (n, 3), at least one.
        most: Points that a hull may be made of.
    """

    def __init__(self, places: Floats, most: int) -> None:
        low = places.min(axis=0)
        span = places.max(axis=0) - low
        side = max(float(span.max()) / _CELLS, 1e-300)
        cells = np.minimum(span // side, _CELLS - 1).astype(np.intp) + 1
        at = np.minimum((places - low) // side, cells - 1).astype(np.intp)
        row = (at[:, 0] * cells[1] + at[:, 1]) * cells[2] + at[:, 2]
        order = np.argsort(row, kind="stable")
        self.places = np.ascontiguousarray(places[order])
        ends = np.arange(int(np.prod(cells)) + 1)
        self.starts = np.searchsorted(row[order], ends).astype(np.int32)
        self.low, self.side, self.cells = low, side, cells
        self.builder = HullBuilder(most)
        self.rows = np.zeros(most, np.int32)
        self.box = np.zeros((3, 2), np.intp)

    def corners(self, points: Floats) -> Indices | None:
        """Return the rows of the points that are corners of their hull, None if it holds a place.

        Points in a plane have no hull: all are returned.

        Args:
            points: [m], shape (n, 3).
        """
        count = self.keep(points)
        return None if count < 0 else np.array(self.rows[:count], np.intp)

    def keep(self, points: Floats) -> int:
        """Write the ``rows`` of points that are corners of their hull; return how many these are.

        Returns -1 if it holds a place.
        """
        if not self.builder.build(points):
            for n in range(points.shape[0]):
                self.rows[n] = n
            return points.shape[0]
        if self.search(points):
            return -1
        return self.builder.write_corners(points.shape[0], self.rows)

    def search(self, points: Floats) -> bool:
        """Return whether a place is in the hull that was built of these points."""
        box = self.box
        for axis in range(3):
            least = most = points[0, axis]
            for n in range(1, points.shape[0]):
                least = min(least, points[n, axis])
                most = max(most, points[n, axis])
            box[axis, 0] = self.cell_of(least, axis)
            box[axis, 1] = self.cell_of(most, axis)
        last = -1
        for i in range(box[0, 0], box[0, 1] + 1):
            for j in range(box[1, 0], box[1, 1] + 1):
                row = (i * self.cells[1] + j) * self.cells[2]
                for n in range(self.starts[row + box[2, 0]], self.starts[row + box[2, 1] + 1]):
                    last = self.builder.holds(
                        self.places[n, 0], self.places[n, 1], self.places[n, 2], last
                    )
                    if last < 0:
                        return True
        return False

    def cell_of(self, place: float, axis: int) -> int:
        """Return the cell along an axis, the first or last beyond the grid."""
        cell = (place - self.low[axis]) / self.side
        if cell <= 0.0:
            return 0
        if cell >= self.cells[axis] - 1:
            return self.cells[axis] - 1
        return cython.cast(cython.Py_ssize_t, cell)
