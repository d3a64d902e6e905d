"""Outlines of bitmaps."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def bitmap_outline(cells: NDArray[np.bool_]) -> NDArray[np.int64]:
    """Return the longest segments around the true cells, those on their left: x0, y0, x1, y1.

    In cells from the lower left corner of the first, shape (n, 4).
    """
    level = _runs(cells)
    upright = _runs(np.ascontiguousarray(cells.T))[:, [1, 0, 3, 2]]
    # seen from the other side left and right change places
    return np.vstack([level, upright[:, [2, 3, 0, 1]]])


def _runs(cells: NDArray[np.bool_]) -> NDArray[np.int64]:
    """Return the edges between rows, joined where they continue."""
    framed = np.pad(cells, 1).astype(np.int8)
    change = np.diff(framed, axis=0)  # 1: a wall begins above the edge, -1: it ends
    found = []
    for sign in (1, -1):
        steps = np.diff((change == sign).view(np.int8), axis=1)
        rows, starts = np.nonzero(steps == 1)
        ends = np.nonzero(steps == -1)[1]
        first, last = (starts, ends) if sign == 1 else (ends, starts)
        found.append(np.stack([first, rows, last, rows], axis=1))
    return np.vstack(found).astype(np.int64)
