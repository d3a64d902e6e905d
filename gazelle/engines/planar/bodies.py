# cython: annotation_typing=False, infer_types=True
# mypy: disable-error-code="attr-defined, misc, no-any-return"
"""The tables of a fleet, as kernels see them."""

from __future__ import annotations

from typing import Any

import cython


@cython.cclass
class Bodies:
    """Bodies of all worlds, and what stands still around them.

    A table of bodies has a row for each body of each world, world by world. Columns are those
    of ``columns``.

    Attributes:
        nbody: Bodies in a world.
        nworld: Number of worlds.
        dt: Of a step [s].
        widest: Radius of the largest body about its origin [m].
        euler: Whether a step goes straight and then turns, as in Stage, not along an arc.
        sweep: Whether what is in the way is looked for on the way too.
        rows: Poses of bodies, shape (nworld * nbody, BODY).
        goal: Poses after this step without collisions; as ``rows``.
        command: Wanted velocities, shape (nworld * nbody, 3).
        velocity: Velocities of the drives; as ``command``.
        kinds: Kinds of the bodies, shape (nbody, KIND_OF_BODY).
        drives: Their drives, shape (nbody, DRIVE), or (1, DRIVE) if that is the same for all.
        pieces: Convex pieces, shape (n, PIECE).
        corners: Of the pieces, shape (n, 2).
        visuals: Primitives that rays meet, shape (n, PRIMITIVE).
        statics: Static parts, shape (n, PRIMITIVE).
        lanes: The same, one column each, where there are few; else none.
        grid: See ``grid_cells``.
        start: First item of each cell.
        items: Statics in the cells.
        near_grid: A finer one over statics alone.
        near_start: First item of each of its cells.
        near_items: Statics in the cells.
        head: First body in each cell of each world, shape (nworld, cells).
        follow: The next body in the same cell, shape (nworld * nbody,).
        cell: The cell of each body, shape (nworld * nbody,).
        state: Outcome of a body's step, shape (nworld * nbody,).
        stalled: Whether the last move was not made, shape (nworld * nbody,).
        way: Length of each body's way in this step [m], where threads share a world.
        memory: Memory of the kernels for each body, shape (nworld * nbody, MEMORY).
    """

    def __init__(self, **tables: Any) -> None:
        for name, table in tables.items():
            setattr(self, name, table)
