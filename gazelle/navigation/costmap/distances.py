"""Exact distances on a grid: from every cell to the nearest one that is marked.

Method: A. Meijster, J. Roerdink and W. Hesselink, "A general algorithm for computing distance
transforms in linear time", 2000: first along columns, then the lower envelope of parabolas along
each row. All in ints, so that the result is exact.
"""

# mypy: disallow-untyped-decorators=False

import cython
import numpy as np

from gazelle.array_types import Bytes, Ints32

FAR = 1 << 29
"""The squared distance of cells when none is marked."""


def squared_distances(marked: Bytes) -> Ints32:
    """Return squared distances to the nearest marked cell [cells²], shape (rows, columns).

    Args:
        marked: Not 0 where a cell is marked, shape (rows, columns).
    """
    rows, columns = marked.shape
    result = np.empty((rows, columns), np.int32)
    if not marked.any():
        result.fill(FAR)
        return result
    seen = np.ascontiguousarray(marked, np.uint8)
    along = np.empty((rows, columns), np.int32)
    stack = np.empty((2, columns + 1), np.int32)
    _transform(seen, along, stack, result)
    return result


@cython.ccall
def _transform(
    marked: cython.uchar[:, ::1],
    along: cython.int[:, ::1],
    stack: cython.int[:, ::1],
    result: cython.int[:, ::1],
) -> cython.void:
    """Fill ``result``; ``along`` and ``stack`` are memory to work in."""
    row: cython.int
    column: cython.int
    rows: cython.int = marked.shape[0]
    columns: cython.int = marked.shape[1]
    most: cython.int = rows + columns
    for column in range(columns):
        along[0, column] = 0 if marked[0, column] else most
    for row in range(1, rows):
        for column in range(columns):
            along[row, column] = 0 if marked[row, column] else along[row - 1, column] + 1
    for row in range(rows - 2, -1, -1):
        for column in range(columns):
            along[row, column] = min(along[row, column], along[row + 1, column] + 1)
    for row in range(rows):
        _envelope(along, stack, result, row, columns)


@cython.cfunc
@cython.exceptval(check=False)
def _envelope(
    along: cython.int[:, ::1],
    stack: cython.int[:, ::1],
    result: cython.int[:, ::1],
    row: cython.int,
    columns: cython.int,
) -> cython.void:
    """Compute one row: ``stack`` holds the parabolas of the envelope and where each begins."""
    top: cython.int = 0
    u: cython.int
    i: cython.int
    g: cython.int
    h: cython.int
    begin: cython.int
    stack[0, 0] = 0
    stack[1, 0] = 0
    for u in range(1, columns):
        g = along[row, u]
        while top >= 0:
            i, begin = stack[0, top], stack[1, top]
            h = along[row, i]
            if (begin - i) * (begin - i) + h * h > (begin - u) * (begin - u) + g * g:
                top -= 1
            else:
                break
        if top < 0:
            top = 0
            stack[0, 0] = u
            stack[1, 0] = 0
        else:
            i = stack[0, top]
            h = along[row, i]
            begin = 1 + _quotient(u * u - i * i + g * g - h * h, 2 * (u - i))
            if begin < columns:
                top += 1
                stack[0, top] = u
                stack[1, top] = begin
    for u in range(columns - 1, -1, -1):
        i = stack[0, top]
        h = along[row, i]
        result[row, u] = (u - i) * (u - i) + h * h
        if u == stack[1, top]:
            top -= 1


@cython.cfunc
@cython.exceptval(check=False)
def _quotient(a: cython.int, b: cython.int) -> cython.int:
    """Return the quotient rounded down, in Python as in C; ``b`` is positive."""
    if a >= 0:
        return a // b
    return -((-a + b - 1) // b)
