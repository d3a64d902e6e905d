"""A controller in native code: roam about, turn away from what is near, back off when stuck."""

from __future__ import annotations

from gazelle.engines.native import kernel, part
from gazelle.engines.planar.kernels_noise import stream, uniform
from gazelle.engines.planar.tables import Flags, Floats, Indices

# Columns of a manner: cruising speed [m/s], fastest turn [rad/s], distance at which to turn
# away [m], and for how many steps a turn and a way back are kept.
CRUISE, TURNING, SHY, KEEP, BACK = 0, 1, 2, 3, 4


@part
def sides(ranges: Floats, m: int) -> tuple[float, float]:
    """The shortest range on the right half and on the left half of a fan; the middle is left."""
    count = ranges.shape[1]
    right, left = ranges[m, 0], ranges[m, count - 1]
    for k in range(count // 2):
        right = min(right, ranges[m, k])
        left = min(left, ranges[m, count - 1 - k])
    return right, min(left, ranges[m, count // 2])


@kernel
def roam(
    first: int, last: int, manner: Floats, seed: int, clock: Indices, sensor: Indices,
    ranges: Floats, command: Floats, stalled: Flags, mood: Indices,
) -> None:  # fmt: skip
    """Choose the commands of the bodies first to last.

    Args:
        first: Of the bodies.
        last: The one after the last.
        manner: As above.
        seed: Of the turns.
        clock: Number of the step.
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
                dice = stream(seed, b, clock[0])
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
            turn = 2.0 * uniform(stream(seed, b, clock[0]), 1) - 1.0
            command[b, 0], command[b, 2] = manner[CRUISE], 0.5 * turn * manner[TURNING]
            mood[b, 1] = int(manner[KEEP])
        mood[b, 1] -= 1
