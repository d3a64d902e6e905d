"""A step of all bodies: plan, find who is in whose way, settle that in order, and move."""

# ruff: noqa: FBT001  # kernels take their arguments in order

from __future__ import annotations

from gazelle.engines.native import kernel, whole
from gazelle.engines.planar.columns import BLOCKED, MOVING, UNDECIDED
from gazelle.engines.planar.kernels_bump import obstructed, statics_meet
from gazelle.engines.planar.kernels_grid import relink
from gazelle.engines.planar.kernels_motion import commit, looks_on_the_way, propose
from gazelle.engines.planar.tables import Cells, Flags, Floats, Marks


@kernel
def plan(
    first: int, last: int, drives: Floats, command: Floats, velocity: Floats, pose: Floats,
    goal: Floats, state: Marks, dt: float, euler: bool, kinds: Floats, pieces: Floats,
    corners: Floats, statics: Floats, grid: Floats, start: Cells, items: Cells, lanes: Floats,
) -> float:  # fmt: skip
    """Where the bodies first to last would go, if nothing static bars it; the longest way [m]."""
    longest = propose(first, last, drives, command, velocity, pose, goal, state, dt, euler)
    nbody = kinds.shape[0]
    for b in range(first, last):
        if state[b] == MOVING and statics_meet(
            b, b % nbody, kinds, pieces, corners, goal, statics, grid, start, items, lanes
        ):
            state[b] = BLOCKED
    return float(longest)


@kernel
def screen(
    first: int, last: int, reach: float, kinds: Floats, pieces: Floats, corners: Floats,
    pose: Floats, goal: Floats, state: Marks, grid: Floats, head: Cells, follow: Cells,
) -> None:  # fmt: skip
    """Mark bodies whose way depends on what others do, or is barred by one that stands."""
    nbody = kinds.shape[0]
    for b in range(first, last):
        if (
            nbody > 1
            and state[b] == MOVING
            and obstructed(
                b, reach, nbody, kinds, pieces, corners, pose, goal, state, grid, head, follow
            )
        ):
            state[b] = UNDECIDED


@kernel
def settle(
    first: int, last: int, reach: float, kinds: Floats, pieces: Floats, corners: Floats,
    pose: Floats, goal: Floats, state: Marks, stalled: Flags, grid: Floats, head: Cells,
    follow: Cells, cell: Cells,
) -> None:  # fmt: skip
    """Decide the rest in order, and move; the bodies are those of whole worlds."""
    nbody = kinds.shape[0]
    for b in range(first, last):
        if state[b] == UNDECIDED:
            barred = obstructed(
                b, reach, nbody, kinds, pieces, corners, pose, goal, state, grid, head,
                follow,
            )  # fmt: skip
            state[b] = BLOCKED if barred else MOVING
    if commit(first, last, pose, goal, state, stalled) > 0 and head.shape[1] > 1:
        relink(first, last, nbody, grid, pose, head, follow, cell)


@whole
def advance(
    first: int, last: int, count: int, widest: float, drives: Floats, command: Floats,
    velocity: Floats, pose: Floats, goal: Floats, state: Marks, stalled: Flags, dt: float,
    euler: bool, kinds: Floats, pieces: Floats, corners: Floats, statics: Floats, grid: Floats,
    start: Cells, items: Cells, lanes: Floats, head: Cells, follow: Cells, cell: Cells,
) -> None:  # fmt: skip
    """Make ``count`` steps with the bodies first to last, which are those of whole worlds."""
    for _ in range(count):
        longest = plan(
            first, last, drives, command, velocity, pose, goal, state, dt, euler,
            kinds, pieces, corners, statics, grid, start, items, lanes,
        )  # fmt: skip
        reach = widest + longest
        screen(first, last, reach, kinds, pieces, corners, pose, goal, state, grid, head, follow)
        settle(
            first, last, reach, kinds, pieces, corners, pose, goal, state, stalled, grid, head,
            follow, cell,
        )  # fmt: skip


@kernel
def looks(
    first: int, last: int, drives: Floats, command: Floats, velocity: Floats, kinds: Floats,
    dt: float,
) -> int:  # fmt: skip
    """``looks_on_the_way`` of the bodies first to last, for who steps a world in parts."""
    return int(looks_on_the_way(first, last, drives, command, velocity, kinds, dt))


@whole
def advance_swept(
    first: int, last: int, count: int, widest: float, drives: Floats, command: Floats,
    velocity: Floats, pose: Floats, goal: Floats, state: Marks, stalled: Flags, dt: float,
    euler: bool, kinds: Floats, pieces: Floats, corners: Floats, statics: Floats, grid: Floats,
    start: Cells, items: Cells, lanes: Floats, head: Cells, follow: Cells, cell: Cells,
) -> None:  # fmt: skip
    """Do what ``advance`` does, and look what is in the way so often that nothing is jumped over.

    Each world by itself, so that none depends on how fast others go.
    """
    nbody = kinds.shape[0]
    for _ in range(count):
        for world in range(first // nbody, last // nbody):
            begin, end = world * nbody, (world + 1) * nbody
            parts = looks_on_the_way(begin, end, drives, command, velocity, kinds, dt)
            advance(
                begin, end, parts, widest, drives, command, velocity, pose, goal, state, stalled,
                dt / parts, euler, kinds, pieces, corners, statics, grid, start, items, lanes,
                head, follow, cell,
            )  # fmt: skip
