"""Beams through columns of voxels: what they pass is free."""

# mypy: disallow-untyped-decorators=False

import cython
from cython.cimports.libc.math import ceil, fabs, floor

from gazelle.array_types import Bytes, Floats, Ints32


def clear_voxels(
    marked: Ints32, unknown: Ints32, cells: Bytes, start: Floats, ends: Floats, limits: Ints32
) -> None:
    """Clear the voxels along lines, and write what the columns they are in cost then.

    Args:
        marked: A bit for each voxel with an obstacle, the lowest first, shape (rows, columns).
        unknown: A bit for each that nothing is known of, likewise.
        cells: Costs of the columns, likewise: 0 or 255; obstacles are left.
        start: Start of the lines: column, row and layer, with parts of them, shape (3,).
        ends: Ends of the lines, shape (n, 3).
        limits: Number of layers; how many marked ones make an obstacle, less one; and how many
            unknown ones make a column unknown, less one; shape (3,).
    """
    _clear(marked, unknown, cells, start, ends, limits)


@cython.ccall
def _clear(
    marked: cython.int[:, ::1],
    unknown: cython.int[:, ::1],
    cells: cython.uchar[:, ::1],
    start: cython.double[::1],
    ends: cython.double[:, ::1],
    limits: cython.int[::1],
) -> cython.void:
    n: cython.Py_ssize_t
    i: cython.int
    count: cython.Py_ssize_t = ends.shape[0]
    for n in range(count):
        dx: cython.double = ends[n, 0] - start[0]
        dy: cython.double = ends[n, 1] - start[1]
        dz: cython.double = ends[n, 2] - start[2]
        longest: cython.double = fabs(dx)
        longest = max(longest, fabs(dy))
        longest = max(longest, fabs(dz))
        steps: cython.int = cython.cast(cython.int, ceil(longest))
        for i in range(steps + 1):
            share: cython.double = 0.0 if steps == 0 else i / cython.cast(cython.double, steps)
            column: cython.int = cython.cast(cython.int, floor(start[0] + share * dx))
            row: cython.int = cython.cast(cython.int, floor(start[1] + share * dy))
            layer: cython.int = cython.cast(cython.int, floor(start[2] + share * dz))
            if column < 0 or row < 0 or column >= cells.shape[1] or row >= cells.shape[0]:
                break
            if layer < 0 or layer >= limits[0]:
                continue
            keep: cython.int = ~(1 << layer)
            marked[row, column] = marked[row, column] & keep
            unknown[row, column] = unknown[row, column] & keep
            if _bits(marked[row, column]) <= limits[1]:
                dark: cython.bint = _bits(unknown[row, column]) > limits[2]
                cells[row, column] = 255 if dark else 0


@cython.cfunc
@cython.exceptval(check=False)
def _bits(value: cython.int) -> cython.int:
    """Count the bits that are set."""
    count: cython.int = 0
    while value != 0:
        value = value & (value - 1)
        count += 1
    return count
