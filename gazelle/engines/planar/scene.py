"""Static scene of a fleet: primitives and the grid over them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from gazelle.array_types import Floats, Ints32
from gazelle.engines.planar import columns as c
from gazelle.engines.planar.clear_space_grid import (
    ClearSpaceGrid,
    clear_space_grid_of,
    corners_of,
    listed,
)
from gazelle.engines.planar.shapes import PrimitiveTable, primitives_of
from gazelle.geometry.planar_part import PlanarPart

_FEW = 100  # primitives up to which all in one cell are drawn faster than they are looked for
_MARGIN = 1e-9  # by which cells are larger than they are [m]
_MOST_CELLS = 1 << 24  # of all worlds together
_NEAR = 0.25  # side of the finer grid's cells [m]
_MOST_NEAR = 1 << 21  # cells


@dataclass(frozen=True, slots=True)
class StaticScene:
    """Static primitives, and which of them are in which cell of a grid.

    Attributes:
        table: The primitives.
        grid: Corner [m], side of a cell [m], columns and rows, shape (5,).
        start: First item of each cell, shape (cells + 1,).
        items: Indices of primitives, cell by cell.
        lanes: The primitives once more, one column each, where there are few; else none.
        near_grid: A finer grid over the primitives alone, for what is near a point; as ``grid``.
        near_start: First item of each of its cells.
        near_items: Indices of primitives, cell by cell.
    """

    table: PrimitiveTable
    grid: Floats
    start: Ints32
    items: Ints32
    lanes: Floats
    near_grid: Floats
    near_start: Ints32
    near_items: Ints32
    _clearings: dict[bool, ClearSpaceGrid] = field(default_factory=dict, init=False)

    @property
    def cells(self) -> int:
        """Number of cells."""
        return len(self.start) - 1

    def clearing(self, *, solid: bool) -> ClearSpaceGrid:
        """Return the clear space that beams can skip; it is made on the first call.

        Args:
            solid: Whether a bitmap's cells may be solid, as they are for beams that begin where
                they start.
        """
        if solid not in self._clearings:
            self._clearings[solid] = clear_space_grid_of(self.table, solid=solid)
        return self._clearings[solid]


def scene_of(
    parts: Sequence[PlanarPart] | PrimitiveTable,
    extent: Floats,
    side: float,
    *,
    nbody: int,
    nworld: int,
) -> StaticScene:
    """Return statics with a grid over them and over an extent.

    Args:
        parts: Static parts.
        extent: Lower left and upper right corner of where bodies are at first [m], shape (2, 2).
        side: Wanted side of a cell [m]; larger if there would be too many cells.
        nbody: Bodies in a world.
        nworld: Worlds.
    """
    table = parts if isinstance(parts, PrimitiveTable) else primitives_of(parts)
    corners = np.vstack((extent, corners_of(table.rows)))
    low, high = corners.min(axis=0), corners.max(axis=0)
    width, height = np.maximum(high - low, 1e-3)
    columns, rows = 1, 1
    if len(table.rows) + nbody > _FEW:
        side = max(side, math.sqrt(width * height * nworld / _MOST_CELLS))
        columns, rows = math.ceil(width / side), math.ceil(height / side)
    grid = np.array([*low, side, columns, rows])
    start, items = listed(table.rows, grid, _MARGIN)
    lanes = _lanes_of(table.rows, columns * rows)
    return StaticScene(table, grid, start, items, lanes, *_near(table.rows))


def _near(rows: Floats) -> tuple[Floats, Ints32, Ints32]:
    """Return a grid over primitives, with small cells."""
    corners = corners_of(rows) if len(rows) else np.zeros((1, 2))
    low, high = corners.min(axis=0), corners.max(axis=0)
    width, height = np.maximum(high - low, 1e-3)
    side = max(_NEAR, math.sqrt(width * height / _MOST_NEAR))
    grid = np.array([*low, side, math.ceil(width / side), math.ceil(height / side)])
    return grid, *listed(rows, grid, _MARGIN)


def _lanes_of(rows: Floats, cells: int) -> Floats:
    if cells > 1 or len(rows) > _FEW:
        return np.zeros((c.LANES, 0))
    circle = (rows[:, c.KIND].astype(int) & 1) == 1
    lanes = np.empty((c.LANES, len(rows)))
    lanes[: c.L_RADIUS] = rows[:, : c.L_RADIUS].T
    lanes[c.L_RADIUS] = np.where(circle, rows[:, c.X1], 0.0)
    lanes[c.X1 : c.L_RADIUS, circle] = lanes[: c.X1, circle]
    lanes[[c.L_LOW, c.L_HIGH, c.L_GLOW]] = rows[:, [c.LOW, c.HIGH, c.GLOW]].T
    return lanes
