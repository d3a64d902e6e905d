# cython: annotation_typing=False, infer_types=True
# mypy: disable-error-code="attr-defined, misc, no-any-return"
"""A controller in native code: go ahead until something is near, then turn away for a while."""

from __future__ import annotations

from typing import Any

import cython
from cython.cimports.gazelle.native.hashed_noise import stream, uniform
from cython.cimports.gazelle.native.system import System

from gazelle.array_types import Floats, Ints64

FEW = 8  # samples with which Stage's own does not run


@cython.cclass
class Wandering(System):
    """Robots that wander, a row each.

    Args:
        commands: Of all bodies of all worlds, written, shape (nworld * nbody, 3).
        ranges: Measured ranges [m], a row a sensor.
        sensors: The sensor of each robot, shape (nworld * robots,).
        owners: Its body, counted through all worlds, likewise.
        nworld: Number of worlds.
        seed: Of how long they turn.
        manner: ``cruise``, the speed ahead [m/s]; ``creep``, that while it turns [m/s]; ``turn``,
            how fast [rad/s]; ``front``, the distance ahead at which it turns away [m]; ``stop``,
            the distance of anything at which it stands [m]; ``patience``, for how many steps it
            turns at least.

    Attributes:
        turn_state: Steps for which each still turns, and 1 or -1 for the way.
    """

    def __init__(
        self,
        commands: Floats,
        ranges: Floats,
        sensors: Ints64,
        owners: Ints64,
        turn_state: Ints64,
        *,
        nworld: int,
        seed: int,
        **settings: Any,
    ) -> None:
        System.__init__(self, max(1, len(owners) // nworld))
        self.commands, self.ranges = commands, ranges
        self.sensors, self.owners = sensors, owners
        self.turn_state, self.seed = turn_state, seed
        self.cruise, self.creep, self.turn = settings["cruise"], settings["creep"], settings["turn"]
        self.front, self.stop = settings["front"], settings["stop"]
        self.patience = settings["patience"]

    def choose(self, first: int, last: int, time: int) -> None:
        """Choose the commands of all robots, without the interpreter's lock."""
        with cython.nogil:
            self.update(first, last, time)

    def update(self, first: int, last: int, time: int) -> None:
        """Choose the commands of robots first to last."""
        for i in range(first, last):
            b = self.owners[i]
            ahead, right, left = room(self.ranges, self.sensors[i])
            halt = min(right, left) < self.stop
            near = halt or ahead < self.front
            if near and self.turn_state[i, 0] < 1:
                drawn = uniform(stream(self.seed, i, time), 0) * self.patience
                self.turn_state[i, 0] = self.patience + cython.cast(cython.longlong, drawn)
                self.turn_state[i, 1] = -1 if left < right else 1
            self.commands[b, 1] = 0.0
            if near or self.turn_state[i, 0] > 0:
                self.commands[b, 0] = 0.0 if halt else self.creep
                self.commands[b, 2] = self.turn * self.turn_state[i, 1]
                self.turn_state[i, 0] -= 1
            else:
                self.commands[b, 0], self.commands[b, 2] = self.cruise, 0.0
                self.turn_state[i, 0] = 0


def room(ranges: Floats, m: int) -> tuple[float, float, float]:
    """Return the shortest range in the middle third, in the right half and in the left one.

    The middle third begins after a third of the samples, and the middle one is of the right
    half, as in Stage.
    """
    count = ranges.shape[1]
    third, half = count // 3, count // 2
    begin = third if count <= FEW else third + 1
    end = max(count - third, begin + 1)
    ahead = right = left = 1e300
    for k in range(count):
        found = ranges[m, k]
        if begin <= k < end:
            ahead = min(ahead, found)
        if k > half:
            left = min(left, found)
        else:
            right = min(right, found)
    return ahead, right, left
