"""A controller in native code: go ahead until something is near, then turn away for a while."""

from __future__ import annotations

import math

from gazelle.engines.native import inner, kernel
from gazelle.engines.planar.kernels_noise import stream, uniform
from gazelle.engines.planar.tables import Floats, Indices

# Columns of a manner: speed ahead [m/s], while it turns [m/s], of turning [rad/s], distance
# ahead at which it turns away, distance of anything at which it stands [m], and least steps
# that it turns for.
CRUISE, CREEP, TURN, FRONT, STOP, PATIENCE = 0, 1, 2, 3, 4, 5

FEW = 8  # samples with which Stage's own does not run


@inner
def room(ranges: Floats, m: int) -> tuple[float, float, float]:
    """The shortest range in the middle third, in the right half and in the left one.

    The middle third begins after a third of the samples, and the middle one is of the right
    half, as in Stage.
    """
    count = ranges.shape[1]
    third, half = count // 3, count // 2
    begin = third if count <= FEW else third + 1
    end = max(count - third, begin + 1)
    ahead, right, left = math.inf, math.inf, math.inf
    for k in range(count):
        found = ranges[m, k]
        if begin <= k < end:
            ahead = min(ahead, found)
        if k > half:
            left = min(left, found)
        else:
            right = min(right, found)
    return ahead, right, left


@kernel
def wander(
    first: int, last: int, manner: Floats, seed: int, clock: Indices, sensors: Indices,
    bodies: Indices, ranges: Floats, command: Floats, mood: Indices,
) -> None:  # fmt: skip
    """Choose the commands of wanderers first to last.

    Args:
        first: Of them.
        last: The one after the last.
        manner: As above.
        seed: Of how long they turn.
        clock: Number of the step.
        sensors: Row of ``ranges`` of each.
        bodies: Row of ``command`` of each.
        ranges: What the sensors measured [m].
        command: What is chosen.
        mood: Steps for which each still turns, and 1 or -1 for the way.
    """
    for i in range(first, last):
        m, b = sensors[i], bodies[i]
        ahead, right, left = room(ranges, m)
        stop = min(right, left) < manner[STOP]
        near = stop or ahead < manner[FRONT]
        if near and mood[i, 0] < 1:
            more = int(uniform(stream(seed, i, clock[0]), 0) * manner[PATIENCE])
            mood[i, 0] = int(manner[PATIENCE]) + more
            mood[i, 1] = -1 if left < right else 1
        turning = near or mood[i, 0] > 0
        command[b, 1] = 0.0
        if turning:
            command[b, 0] = 0.0 if stop else manner[CREEP]
            command[b, 2] = manner[TURN] * mood[i, 1]
            mood[i, 0] -= 1
        else:
            command[b, 0], command[b, 2] = manner[CRUISE], 0.0
            mood[i, 0] = 0
