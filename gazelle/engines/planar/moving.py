# cython: annotation_typing=False, infer_types=True
# mypy: disable-error-code="attr-defined, misc, no-any-return"
"""A step of all bodies: plan, find overlapping bodies, settle that in order, and move."""

from __future__ import annotations

import cython
from cython.cimports.gazelle.engines.planar.bodies import Bodies
from cython.cimports.gazelle.engines.planar.collision import obstructed, statics_meet
from cython.cimports.gazelle.engines.planar.columns import BLOCKED, MOVING, UNDECIDED
from cython.cimports.gazelle.engines.planar.drive_motion import (
    commit,
    count_substeps,
    propose,
)
from cython.cimports.gazelle.engines.planar.grid_cells import relink
from cython.cimports.gazelle.native.system import System


def plan(w: Bodies, first: int, last: int, dt: float) -> float:
    """Plan the moves of the bodies first to last where nothing static blocks; return the longest [m]."""
    longest = propose(w, first, last, dt)
    for b in range(first, last):
        if w.state[b] == MOVING and statics_meet(w, b, b % w.nbody):
            w.state[b] = BLOCKED
    return longest


def screen(w: Bodies, first: int, last: int, reach: float) -> None:
    """Mark bodies with a move that depends on others, or is blocked by one at rest."""
    if w.nbody < 2:
        return
    for b in range(first, last):
        if w.state[b] == MOVING and obstructed(w, b, reach):
            w.state[b] = UNDECIDED


def settle(w: Bodies, first: int, last: int, reach: float) -> None:
    """Resolve the remaining moves in order; the bodies are those of whole worlds."""
    for b in range(first, last):
        if w.state[b] == UNDECIDED:
            w.state[b] = BLOCKED if obstructed(w, b, reach) else MOVING
    if commit(w, first, last) > 0 and w.head.shape[1] > 1:
        relink(w, first, last)


def advance_bodies(w: Bodies, first: int, last: int, count: int, dt: float) -> None:
    """Advance the bodies first to last, which are those of whole worlds, by ``count`` steps."""
    for _ in range(count):
        reach = w.widest + plan(w, first, last, dt)
        screen(w, first, last, reach)
        settle(w, first, last, reach)


def advance_world(w: Bodies, world: int) -> None:
    """Advance one world by a step.

    With ``sweep`` what is in the way is looked for so often that nothing is jumped over.
    """
    begin, end = world * w.nbody, (world + 1) * w.nbody
    parts = count_substeps(w, begin, end) if w.sweep else 1
    advance_bodies(w, begin, end, parts, w.dt / parts)


@cython.cclass
class Planning(System):
    """The first part of a step of large worlds, which threads share: where bodies would go.

    Args:
        bodies: Moving bodies.
    """

    def __init__(self, bodies: Bodies) -> None:
        System.__init__(self, bodies.nbody)
        self.bodies = bodies

    def update(self, first: int, last: int, time: int) -> None:  # noqa: ARG002  time plays no part
        """Plan the ways of the bodies first to last."""
        for b in range(first, last):
            self.bodies.way[b] = plan(self.bodies, b, b + 1, self.bodies.dt)


@cython.cclass
class Screening(System):
    """The second part: which bodies depend on others.

    Args:
        bodies: Moving bodies.
    """

    def __init__(self, bodies: Bodies) -> None:
        System.__init__(self, bodies.nbody)
        self.bodies = bodies

    def update(self, first: int, last: int, time: int) -> None:  # noqa: ARG002  time plays no part
        """Mark those of the bodies first to last with a move that depends on others."""
        b = first
        while b < last:
            end = min((b // self.bodies.nbody + 1) * self.bodies.nbody, last)
            screen(self.bodies, b, end, reach_in(self.bodies, b // self.bodies.nbody))
            b = end


@cython.cclass
class Settling(System):
    """The last part, one after another: decide the rest, and move.

    Args:
        bodies: Moving bodies.
    """

    def __init__(self, bodies: Bodies) -> None:
        System.__init__(self)
        self.bodies = bodies

    def update(self, first: int, last: int, time: int) -> None:  # noqa: ARG002  time plays no part
        """Settle the worlds first to last."""
        for world in range(first, last):
            settle_world(self.bodies, world)


def settle_world(w: Bodies, world: int) -> None:
    """Settle the bodies of one world."""
    settle(w, world * w.nbody, (world + 1) * w.nbody, reach_in(w, world))


def reach_in(w: Bodies, world: int) -> float:
    """Return the greatest distance of another body that one can meet in this step [m]."""
    longest = 0.0
    for b in range(world * w.nbody, (world + 1) * w.nbody):
        longest = max(longest, w.way[b])
    return w.widest + longest
