"""Construction of the grid of clear space that beams can skip."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, Ints32
from gazelle.engines.planar import columns as c
from gazelle.engines.planar import scan_columns as k
from gazelle.engines.planar.clear_space import measure_clear
from gazelle.engines.planar.grid_cells import list_statics
from gazelle.engines.planar.shapes import PrimitiveTable, Raster

LISTED = 1e-6  # by which statics are listed in cells that they do not pass [m]
_CELLS = 12.0  # a static primitive
_FINEST = 0.02  # side of a cell [m]
_LEAST = 1e-4  # side of a bitmap's cell [m]
_MOST_CELLS = 1 << 22


@dataclass(frozen=True, slots=True)
class ClearSpaceGrid:
    """A grid over statics alone, and how far around each cell there are none.

    Attributes:
        fine: The grid, as ``scan_columns`` has it, shape (FINE,).
        start: First item of each cell, shape (cells + 1,).
        items: Indices of primitives, cell by cell.
        clear: Side of the empty square from each cell on in four directions, and around it;
            negative where a cell is solid to its edges. Shape (5 * cells,).
    """

    fine: Floats
    start: Ints32
    items: Ints32
    clear: NDArray[np.int8]


def clear_space_grid_of(table: PrimitiveTable, *, solid: bool) -> ClearSpaceGrid:
    """Return a grid with the cells of the table's bitmap, or some for each of the primitives.

    Args:
        table: Table of primitives.
        solid: Whether the bitmap's cells may be solid instead of having outlines.
    """
    if solid and table.raster is not None:
        made = _of_raster(table, table.raster)
        if made is not None:
            return made
    low, high = _bounds(table.rows)
    width, height = np.maximum(high - low, _FINEST)
    cells = min(max(_CELLS * len(table.rows), 1.0), float(_MOST_CELLS))
    side = max(math.sqrt(width * height / cells), max(width, height) / cells, _FINEST)
    columns, rows = math.ceil(width / side), math.ceil(height / side)
    fine = np.zeros(k.FINE)
    fine[[k.CORNER_U, k.CORNER_V]] = low
    fine[[k.SIDE_U, k.SIDE_V, k.COLUMNS, k.ROWS, k.TURN_COS]] = side, side, columns, rows, 1.0
    start, items = listed(table.rows, np.array([*low, side, columns, rows]), LISTED)
    return _measured(fine, start, items, np.zeros(columns * rows, np.int8))


def _of_raster(table: PrimitiveTable, raster: Raster) -> ClearSpaceGrid | None:
    """Return the grid of a bitmap, extended to cover all primitives; None if too large."""
    (x, y, yaw), (wide, deep) = raster.pose, raster.cell
    if min(wide, deep) < _LEAST:
        return None
    cos, sin = math.cos(yaw), math.sin(yaw)
    others = table.rows.copy()
    others[raster.first : raster.last, c.KIND] = -1.0
    kept = np.flatnonzero(others[:, c.KIND] >= 0.0)
    others = others[kept]
    turned(others, cos, sin, x, y)
    low, high = _bounds(others)
    size = np.array(raster.cells.shape[::-1])
    cell, corner = np.array([wide, deep]), np.array(raster.low)
    around = np.stack(((corner - low) / cell, (high - corner) / cell - size))
    before, after = np.ceil(np.maximum(around, 0.0)) + 1.0
    if (before + size + after).prod() > _MOST_CELLS:
        return None
    before, after = before.astype(np.int64), after.astype(np.int64)
    columns, rows = before + size + after
    corner = corner - before * cell
    solid = np.pad(raster.cells, ((before[1], after[1]), (before[0], after[0])))
    # Cells are made square for the list; circles then are within wider ones.
    stretch = wide / deep
    circle = (others[:, c.KIND].astype(int) & 1) == 1
    others[circle, c.X1] *= max(1.0, stretch)
    others[:, c.Y0] *= stretch
    others[~circle, c.Y1] *= stretch
    grid = np.array([corner[0], corner[1] * stretch, wide, columns, rows])
    start, items = listed(others, grid, LISTED * max(1.0, stretch))
    fine = np.array(
        [*corner, wide, deep, columns, rows, cos, sin, raster.z[0], raster.z[1], raster.first + 1.0]
    )
    # the frame's origin is not at the world's
    fine[k.CORNER_U] += cos * x + sin * y
    fine[k.CORNER_V] += cos * y - sin * x
    return _measured(fine, start, kept[items].astype(np.int32), solid.ravel().astype(np.int8))


def turned(rows: Floats, cos: float, sin: float, x: float, y: float) -> None:
    """Transform primitives to a frame at (x, y), turned."""
    circle = (rows[:, c.KIND].astype(int) & 1) == 1
    radius = rows[circle, c.X1].copy()
    for first, second in ((c.X0, c.Y0), (c.X1, c.Y1)):
        dx, dy = rows[:, first] - x, rows[:, second] - y
        rows[:, first], rows[:, second] = cos * dx + sin * dy, cos * dy - sin * dx
    rows[circle, c.X1] = radius


def _measured(
    fine: Floats, start: Ints32, items: Ints32, solid: NDArray[np.int8]
) -> ClearSpaceGrid:
    clear = np.zeros(5 * len(solid), np.int8)
    measure_clear(solid, start, int(fine[k.COLUMNS]), clear)
    return ClearSpaceGrid(fine, start, items, clear)


def _bounds(rows: Floats) -> tuple[Floats, Floats]:
    """Return the lower left and upper right corner of primitives [m]."""
    found = corners_of(rows)
    if not len(found):
        found = np.zeros((1, 2))
    return found.min(axis=0), found.max(axis=0)


def corners_of(rows: Floats) -> Floats:
    """Return points that bound primitives, shape (n, 2)."""
    circle = (rows[:, c.KIND].astype(int) & 1) == 1
    radius = np.where(circle, rows[:, c.X1], 0.0)[:, None]
    start, end = rows[:, [c.X0, c.Y0]], rows[:, [c.X1, c.Y1]]
    end = np.where(circle[:, None], start, end)
    return np.vstack((start - radius, start + radius, end))


def listed(rows: Floats, grid: Floats, margin: float) -> tuple[Ints32, Ints32]:
    """Return the primitives in each cell of a grid: the start of each cell's list, and indices."""
    start = np.zeros(int(grid[3] * grid[4]) + 1, np.int32)
    list_statics(rows, grid, start, np.zeros(0, np.int32), margin)
    counts = start[:-1].copy()
    start[1:] = np.cumsum(counts)
    start[0] = 0
    items = np.zeros(int(start[-1]), np.int32)
    if len(items):
        list_statics(rows, grid, start[:-1].copy(), items, margin)
    return start, items
