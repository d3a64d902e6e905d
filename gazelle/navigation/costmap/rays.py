"""Beams on a grid: the cells that they pass become free."""

# mypy: disallow-untyped-decorators=False

import cython

from gazelle.array_types import Bytes, Floats


def clear_rays(cells: Bytes, start: tuple[int, int], ends: Floats, most: float) -> None:
    """Write 0 along lines from a cell, the last one of each included.

    Method: Bresenham's lines, cut off where they leave the grid.

    Args:
        cells: Shape (rows, columns), changed in place.
        start: Column and row.
        ends: Columns and rows that lines lead to, ints, on the grid or off it, shape (n, 2).
        most: Longest line [cells].
    """
    if 0 <= start[0] < cells.shape[1] and 0 <= start[1] < cells.shape[0]:
        _clear(cells, start[0], start[1], ends, most)


@cython.ccall
def _clear(
    cells: cython.uchar[:, ::1],
    x0: cython.int,
    y0: cython.int,
    ends: cython.double[:, ::1],
    most: cython.double,
) -> cython.void:
    n: cython.Py_ssize_t
    count: cython.Py_ssize_t = ends.shape[0]
    for n in range(count):
        _line(cells, x0, y0, ends[n, 0], ends[n, 1], most)


@cython.cfunc
@cython.exceptval(check=False)
def _line(
    cells: cython.uchar[:, ::1],
    x0: cython.int,
    y0: cython.int,
    x1: cython.double,
    y1: cython.double,
    most: cython.double,
) -> cython.void:
    dx: cython.double = x1 - x0
    dy: cython.double = y1 - y0
    along: cython.double = dx if dx >= 0.0 else -dx
    aside: cython.double = dy if dy >= 0.0 else -dy
    rows: cython.int = cells.shape[0]
    columns: cython.int = cells.shape[1]
    step_x: cython.int = 1 if dx >= 0.0 else -1
    step_y: cython.int = 1 if dy >= 0.0 else -1
    steep: cython.bint = aside > along
    if steep:
        along, aside = aside, along
    length: cython.double = (along * along + aside * aside) ** 0.5
    share: cython.double = most / length if length > most else 1.0
    steps: cython.int = cython.cast(cython.int, along * share)
    error: cython.double = along / 2.0
    x: cython.int = x0
    y: cython.int = y0
    for _ in range(steps + 1):
        if x < 0 or y < 0 or x >= columns or y >= rows:
            return
        cells[y, x] = 0
        error -= aside
        if steep:
            y += step_y
            if error < 0.0:
                x += step_x
                error += along
        else:
            x += step_x
            if error < 0.0:
                y += step_y
                error += along
