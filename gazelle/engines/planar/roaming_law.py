# cython: annotation_typing=False, infer_types=True
# mypy: disable-error-code="attr-defined, misc, no-any-return"
"""A controller in native code: roam about, turn away from what is near, back off when stuck."""

from __future__ import annotations

import cython
from cython.cimports.gazelle.engines.planar.bodies import Bodies
from cython.cimports.gazelle.native.hashed_noise import stream, uniform
from cython.cimports.gazelle.native.system import System

from gazelle.array_types import Floats, Ints64


@cython.cclass
class RoamingLaw(System):
    """Bodies that roam, a row each.

    Args:
        bodies: Of all worlds.
        ranges: Measured ranges [m], a row a sensor.
        sensor: The sensor of each body; -1 for none.
        turn_state: Steps for which each still backs off, and for which it keeps its turn, shape (n, 2).
        seed: Of the turns.
        cruise: Speed ahead [m/s].
        turning: Fastest turn [rad/s].
        avoid_distance: Distance at which to turn away from something [m].
        keep: Steps for which a turn is kept.
        back: Steps for which to back off.
    """

    def __init__(
        self,
        bodies: Bodies,
        ranges: Floats,
        sensor: Ints64,
        turn_state: Ints64,
        *,
        seed: int,
        cruise: float,
        turning: float,
        avoid_distance: float,
        keep: int,
        back: int,
    ) -> None:
        System.__init__(self, bodies.nbody)
        self.bodies, self.ranges, self.sensor, self.turn_state = bodies, ranges, sensor, turn_state
        self.cruise, self.turning, self.avoid_distance = cruise, turning, avoid_distance
        self.keep, self.back, self.seed = keep, back, seed

    def choose(self, time: int) -> None:
        """Choose the commands of all bodies."""
        self.update(0, self.turn_state.shape[0], time)

    def update(self, first: int, last: int, time: int) -> None:
        """Choose the commands of bodies first to last; ``time`` counts steps."""
        for b in range(first, last):
            if self.bodies.stalled[b] and self.turn_state[b, 0] == 0:
                self.turn_state[b, 0], self.turn_state[b, 1] = self.back, 0
            if self.turn_state[b, 0] > 0:
                self.back_off(b, time)
                continue
            if self.sensor[b] >= 0 and self.turns_away(b):
                continue
            if self.turn_state[b, 1] <= 0:
                drawn = 2.0 * uniform(stream(self.seed, b, time), 1) - 1.0
                self.bodies.command[b, 0] = self.cruise
                self.bodies.command[b, 2] = 0.5 * drawn * self.turning
                self.turn_state[b, 1] = self.keep
            self.turn_state[b, 1] -= 1

    def back_off(self, b: int, time: int) -> None:
        """Continue backing a body off from what stopped it."""
        self.turn_state[b, 0] -= 1
        if self.turn_state[b, 1] != -1:
            dice = stream(self.seed, b, time)
            way = -0.5 if uniform(dice, 2) < 0.8 else 0.5  # behind it may be as tight
            self.bodies.command[b, 0] = way * self.cruise
            self.bodies.command[b, 2] = (2.0 * uniform(dice, 0) - 1.0) * self.turning
            self.turn_state[b, 1] = -1

    def turns_away(self, b: int) -> bool:
        """Turn a body away from near obstacles; returns whether there are any."""
        right, left = sides(self.ranges, self.sensor[b])
        if min(right, left) >= self.avoid_distance:
            return False
        self.bodies.command[b, 0] = 0.25 * self.cruise
        self.bodies.command[b, 2] = self.turning if right < left else -self.turning
        self.turn_state[b, 1] = 0
        return True


def sides(ranges: Floats, m: int) -> tuple[float, float]:
    """Return the shortest range on the right half and on the left half of a fan.

    The middle is left.
    """
    count = ranges.shape[1]
    right, left = ranges[m, 0], ranges[m, count - 1]
    for k in range(count // 2):
        right = min(right, ranges[m, k])
        left = min(left, ranges[m, count - 1 - k])
    return right, min(left, ranges[m, count // 2])
