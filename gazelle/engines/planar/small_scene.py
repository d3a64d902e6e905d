"""Small scenes as what faces sensors, which scans them fastest."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats
from gazelle.engines.planar import columns as c
from gazelle.engines.planar.fleet import Fleet
from gazelle.engines.planar.front_faces import FrontFaces
from gazelle.engines.planar.scan_columns import ROOM


def front_faces_of(fleet: Fleet) -> FrontFaces | None:
    """Return the faces of a fleet and its surroundings; None if they are too many, or in a grid.

    Each thread needs one of its own, as scans are made on it.
    """
    statics = fleet.scene.table.rows
    visuals = [_rows_of(fleet, body) for body in range(fleet.nbody)]
    flat = [_sides(rows) for rows in (statics, *visuals)]
    discs, fixed = [_discs(rows) for rows in visuals], _discs(statics)
    if fleet.scene.cells > 1 or sum(map(len, (*flat, *discs, fixed))) > ROOM:
        return None
    ends = np.cumsum([len(sides) for sides in flat])
    rounds = np.cumsum([0, *map(len, discs)])
    spans = np.stack((ends[:-1], ends[1:], rounds[:-1], rounds[1:]), axis=1).astype(np.int64)
    empty = np.zeros((0, 5))
    return FrontFaces(np.vstack(flat), len(flat[0]), fixed, np.vstack([empty, *discs]), spans)


def _rows_of(fleet: Fleet, body: int) -> Floats:
    first, last = fleet.kinds[body, [c.FIRST_VISUAL, c.LAST_VISUAL]].astype(int)
    rows: Floats = fleet.visuals[first:last]
    return rows


def _is_disc(rows: Floats) -> NDArray[np.bool_]:
    found: NDArray[np.bool_] = (rows[:, c.KIND].astype(int) & int(c.CIRCLE)) != 0
    return found


def _sides(rows: Floats) -> Floats:
    """Return ends of visible segments, whether from both sides, and heights, shape (n, 7)."""
    rows = rows[~_is_disc(rows) & (rows[:, c.GLOW] >= 0.0)]
    is_open = (rows[:, c.KIND].astype(int) & int(c.OPEN)) != 0
    ends = rows[:, [c.X0, c.Y0, c.X1, c.Y1]]
    return np.column_stack((ends, is_open, rows[:, c.LOW], rows[:, c.HIGH]))


def _discs(rows: Floats) -> Floats:
    """Return middles, radii and heights of visible discs, shape (n, 5)."""
    rows = rows[_is_disc(rows) & (rows[:, c.GLOW] >= 0.0)]
    return np.ascontiguousarray(rows[:, [c.X0, c.Y0, c.X1, c.LOW, c.HIGH]])
