"""Outlines of a fleet's bodies, for maps and drawings."""

from __future__ import annotations

from dataclasses import dataclass

from gazelle.argument_checks import indices, world_indices
from gazelle.array_types import Floats
from gazelle.engines.planar import columns as c
from gazelle.engines.planar.clear_space_grid import turned
from gazelle.engines.planar.fleet import Fleet
from gazelle.engines.planar.shapes import PrimitiveTable
from gazelle.errors import EngineError


@dataclass(frozen=True, slots=True)
class Footprint:
    """Solid parts of a body, in its own frame.

    Attributes:
        polygons: Convex, counter-clockwise [m], shapes (n, 2).
        discs: Middles and radii [m].
        radius: Of all of it about the body's origin [m].
    """

    polygons: list[Floats]
    discs: list[tuple[float, float, float]]
    radius: float


def footprint_of(fleet: Fleet, body: int) -> Footprint:
    """Return the solid parts of a body.

    Raises:
        EngineError: There is no such body.
    """
    (kind,) = fleet.kinds[indices("bodies", [body], fleet.nbody, EngineError)]
    found = Footprint([], [], float(kind[c.RADIUS]))
    for piece in fleet.pieces[int(kind[c.FIRST_PIECE]) : int(kind[c.LAST_PIECE])]:
        if piece[c.COUNT] == 0:
            x, y, radius = piece[[c.CENTRE_X, c.CENTRE_Y, c.BOUND]].tolist()
            found.discs.append((x, y, radius))
        else:
            first = int(piece[c.FIRST])
            found.polygons.append(fleet.corners[first : first + int(piece[c.COUNT])])
    return found


def outline_of(fleet: Fleet, body: int, world: int = 0) -> PrimitiveTable:
    """Return what rays meet of a body, in the frame of its world.

    Raises:
        EngineError: There is no such body or world.
    """
    (place,) = indices("bodies", [body], fleet.nbody, EngineError)
    (row,) = world_indices([world], fleet.nworld, EngineError)
    first, last = fleet.kinds[place, [c.FIRST_VISUAL, c.LAST_VISUAL]].astype(int)
    x, y, _, cos, sin, z = fleet.rows[row * fleet.nbody + place, :6]
    rows = fleet.visuals[first:last].copy()
    rows[:, [c.LOW, c.HIGH]] += z
    # ``turned`` gives coordinates in a frame that is at (x, y): here it is the way back.
    turned(rows, cos, -sin, -(cos * x + sin * y), sin * x - cos * y)
    return PrimitiveTable(rows, fleet.tags[first:last])
