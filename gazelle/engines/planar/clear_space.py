# cython: infer_types=True, annotation_typing=False
"""Clear space without statics: a grid of distances that beams can skip.

Statics have a grid of their own for this, the finer the more of them there are; where there is a
bitmap, its cells are that grid's. For each of four directions ``clear`` says how large a square
of empty cells begins at a cell and goes there, and last how large one is all around it: a beam
continues to the edge of its square at once. It is 0 where primitives are listed, and negative where
a cell is solid to its edges.
"""

from __future__ import annotations

import cython
import numpy as np
from cython.cimports.gazelle.engines.planar.scan_columns import SOLID_HIGH, SOLID_LOW, SOLID_NAME
from numpy.typing import NDArray

from gazelle.array_types import Floats, Ints32

MOST_CLEAR = cython.declare(cython.int, 120)  # cells


class ClearSpace:
    """A grid over statics alone, and how far around each cell there are none.

    Attributes:
        fine: The grid, as ``columns.CORNER_U`` and what follows say, shape (FINE,).
        start: First item of each cell, shape (cells + 1,).
        items: Indices of primitives, cell by cell.
        clear: Side of the empty square from each cell on in four directions, and around it;
            negative where a cell is solid to its edges. Shape (5 * cells,).
    """

    def __init__(self, fine: Floats, start: Ints32, items: Ints32, clear: NDArray[np.int8]) -> None:
        self.fine, self.start, self.items, self.clear = fine, start, items, clear

    def is_clear(self, height: float) -> bool:
        """Return whether solid cells are solid at this height; if not, beams must not skip them."""
        if self.fine[SOLID_NAME] == 0.0:
            return True
        inside: bool = height >= self.fine[SOLID_LOW] and height <= self.fine[SOLID_HIGH]
        return inside


def measure_clear(
    solid: NDArray[np.int8], start: Ints32, columns: int, clear: NDArray[np.int8]
) -> None:
    """Find the largest empty square from each cell on, in each direction, and around it.

    Each is one more than the least of the three before it.

    Args:
        solid: Whether a cell is solid to its edges.
        start: First item of each cell, and last the number of items.
        columns: Of the grid.
        clear: Comes out, see ``ClearSpace``.
    """
    cells = solid.shape[0]
    rows = cells // columns
    for quadrant in range(4):
        base = quadrant * cells
        step = 1 if quadrant < 2 else -1
        line = columns if quadrant % 2 == 0 else -columns
        for i in range(rows):
            row = rows - 1 - i if line > 0 else i
            for j in range(columns):
                column = columns - 1 - j if step > 0 else j
                cell = row * columns + column
                least = MOST_CLEAR
                inside = column + step >= 0 and column + step < columns
                if inside:
                    least = min(least, clear[base + cell + step])
                if i > 0:
                    least = min(least, clear[base + cell + line])
                if inside and i > 0:
                    least = min(least, clear[base + cell + line + step])
                least = min(max(least, 0) + 1, MOST_CLEAR)
                if start[cell + 1] > start[cell]:
                    least = 0
                clear[base + cell] = -1 if solid[cell] != 0 else least
    for cell in range(cells):
        least = min(clear[cell], clear[cells + cell])
        least = min(least, clear[2 * cells + cell])
        clear[4 * cells + cell] = min(least, clear[3 * cells + cell])
