"""A controller in native code: roam about, turn away from what is near, back off when stuck."""

# ruff: noqa: FBT001  # kernels take their arguments in order

from __future__ import annotations

from gazelle.engines.native import kernel, part
from gazelle.engines.planar.kernels_noise import stream, uniform
from gazelle.engines.planar.kernels_scan import scan
from gazelle.engines.planar.kernels_step import advance
from gazelle.engines.planar.tables import Cells, Flags, Floats, Indices, Marks

# Columns of a manner: cruising speed [m/s], fastest turn [rad/s], distance at which to turn
# away [m], and for how many steps a turn and a way back are kept.
CRUISE, TURNING, SHY, KEEP, BACK = 0, 1, 2, 3, 4


@part
def sides(ranges: Floats, m: int) -> tuple[float, float]:
    """The shortest range on the right half and on the left half of a fan."""
    count = ranges.shape[1]
    right, left = ranges[m, 0], ranges[m, count - 1]
    for k in range(count // 2):
        right = min(right, ranges[m, k])
        left = min(left, ranges[m, count - 1 - k])
    return right, left


@kernel
def roam(
    first: int, last: int, manner: Floats, seed: int, tick: int, sensor: Indices, ranges: Floats,
    command: Floats, stalled: Flags, mood: Indices,
) -> None:  # fmt: skip
    """Choose the commands of the bodies first to last.

    Args:
        first: Of the bodies.
        last: The one after the last.
        manner: As above.
        seed: Of the turns.
        tick: Number of the step.
        sensor: Row of ``ranges`` of each body; -1 for none.
        ranges: What the sensors measured [m].
        command: What is chosen.
        stalled: Who could not move.
        mood: Steps for which each body still backs off, and those for which it keeps its turn.
    """
    for b in range(first, last):
        if stalled[b] and mood[b, 0] == 0:
            mood[b, 0], mood[b, 1] = int(manner[BACK]), 0
        if mood[b, 0] > 0:
            mood[b, 0] -= 1
            if mood[b, 1] != -1:
                dice = stream(seed, b, tick)
                way = -0.5 if uniform(dice, 2) < 0.8 else 0.5  # behind it may be as tight
                command[b, 0] = way * manner[CRUISE]
                command[b, 2] = (2.0 * uniform(dice, 0) - 1.0) * manner[TURNING]
                mood[b, 1] = -1
            continue
        if sensor[b] >= 0:
            right, left = sides(ranges, sensor[b])
            if min(right, left) < manner[SHY]:
                command[b, 0] = 0.25 * manner[CRUISE]
                command[b, 2] = manner[TURNING] if right < left else -manner[TURNING]
                mood[b, 1] = 0
                continue
        if mood[b, 1] <= 0:
            turn = 2.0 * uniform(stream(seed, b, tick), 1) - 1.0
            command[b, 0], command[b, 2] = manner[CRUISE], 0.5 * turn * manner[TURNING]
            mood[b, 1] = int(manner[KEEP])
        mood[b, 1] -= 1


@kernel
def rounds(
    count: int, manner: Floats, seed: int, tick: int, sensor: Indices, mood: Indices,
    widest: float, drives: Floats, command: Floats, velocity: Floats, pose: Floats, goal: Floats,
    state: Marks, stalled: Flags, dt: float, euler: bool, kinds: Floats, pieces: Floats,
    corners: Floats, statics: Floats, grid: Floats, start: Cells, items: Cells, lanes: Floats, head: Cells,
    follow: Cells, cell: Cells, looks: Floats, sensors: Floats, owners: Indices, mounts: Floats,
    fan: Floats, outline: Floats, beams: Floats, view: Floats, stamp: Indices, walls: Floats,
    others: Floats, ranges: Floats, names: Floats,
) -> None:  # fmt: skip
    """Let all bodies roam for ``count`` steps, scanning with all sensors after each."""
    total = pose.shape[0]
    for now in range(count):
        roam(0, total, manner, seed, tick + now, sensor, ranges, command, stalled, mood)
        advance(
            0, total, 1, widest, drives, command, velocity, pose, goal, state, stalled, dt, euler,
            kinds, pieces, corners, statics, grid, start, items, lanes, head, follow, cell,
        )  # fmt: skip
        scan(
            0, owners.size, sensors, owners, mounts, fan, outline, widest, grid, statics, start,
            items, lanes, kinds, looks, pose, head, follow, beams, view, stamp, walls, others, ranges,
            names,
        )  # fmt: skip
