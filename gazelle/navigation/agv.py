"""The motions of automated guided vehicles: straight to a point, turn by, turn to.

Poses in, velocities out: where they come from and go to is up to the caller, so that
the same motions drive robots of a simulation, of a ROS graph, or real ones.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import IntEnum

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gazelle.argument_checks import checked
from gazelle.array_types import Floats, Indices
from gazelle.engines.limits import MAX_WORLDS, integer
from gazelle.errors import ControlError
from gazelle.navigation.pid import BoundedPid

_STANDS = 0.25  # of a tolerance, between two updates


class Outcome(IntEnum):
    """State of a robot's last motion."""

    IDLE = 0
    MOVING = 1
    REACHED = 2
    TIMED_OUT = 3
    CANCELLED = 4


@checked(ControlError)
@dataclass(frozen=True, slots=True)
class Limits:
    """Limits of speed and accuracy of motions.

    Attributes:
        linear: Fastest [m/s].
        angular: Fastest [rad/s].
        distance: A point this near is reached [m].
        angle: A heading this near is reached [rad].
        turn_first: With the point farther off ahead than this a robot turns on the spot [rad].
        gain: Speed for each metre to go [1/s].
        turn_gain: Yaw rate for each radian to turn [1/s].
        turn_integral: Gain on the integral of the angle, for robots that stick [1/s²].
        turn_most: Largest contribution of the integral [rad/s].
    """

    linear: float = 0.5
    angular: float = 1.0
    distance: float = 0.02
    angle: float = 0.01
    turn_first: float = 0.1
    gain: float = 1.5
    turn_gain: float = 2.0
    turn_integral: float = 0.0
    turn_most: float = 0.2

    def __post_init__(self) -> None:
        for name in ("linear", "angular", "distance", "angle", "turn_first", "gain", "turn_gain"):
            if not getattr(self, name) > 0.0:
                raise ControlError(f"{name} must be positive, not {getattr(self, name)}")


@checked(ControlError)
class Motions:
    """The motions of ``count`` robots, each with one at a time.

    Give one to a robot, then call ``update`` with poses, and command what it returns, until
    ``active`` is False. A new motion takes the place of an old one.

    Args:
        count: Number of robots.
        limits: Of all of them.

    Attributes:
        outcome: Outcome of each robot's last motion, values of ``Outcome``, shape (count,).
        taken: Duration so far [s], shape (count,).
    """

    def __init__(self, count: int = 1, limits: Limits | None = None) -> None:
        self.count = integer("the number of robots", count, least=0, most=MAX_WORLDS)
        self.limits = limits or Limits()
        self.outcome = np.full(count, Outcome.IDLE, np.int8)
        self.taken = np.zeros(count)
        self._goal = np.zeros((count, 2))
        self._straight = np.zeros(count, np.bool_)
        self._aligned = np.zeros(count, np.bool_)
        self._heading = np.zeros(count)
        self._relative = np.zeros(count, np.bool_)
        self._turned = np.full(count, math.nan)  # the last heading, of those that turn by
        self._limit = np.zeros(count)
        self._start = np.full(count, math.nan)
        self._last = math.nan
        self._before = np.full((count, 3), math.nan)  # poses at the last update
        most = self.limits.turn_most
        self._pid = BoundedPid(
            self.limits.turn_gain,
            self.limits.turn_integral,
            integral=(-most, most),
            output=(-self.limits.angular, self.limits.angular),
            count=count,
        )

    @property
    def active(self) -> NDArray[np.bool_]:
        """True for robots with a motion in progress, shape (count,)."""
        moving: NDArray[np.bool_] = self.outcome == Outcome.MOVING
        return moving

    def move_l(
        self, x: ArrayLike, y: ArrayLike, robots: ArrayLike | None = None, *, timeout: float = 60.0
    ) -> None:
        """Drive straight to a point, turning to it first.

        Args:
            x: Of the point [m], one for all or shape (n,).
            y: Of the point [m].
            robots: Indices; all if None.
            timeout: Simulated time after which the motion ends [s].

        Raises:
            ControlError: There is no such robot, or a value is not finite.
        """
        rows = self._begin(robots, timeout, x, y)
        self._straight[rows], self._aligned[rows] = True, False
        self._goal[rows, 0], self._goal[rows, 1] = x, y

    def move_c(
        self, angle: ArrayLike, robots: ArrayLike | None = None, *, timeout: float = 60.0
    ) -> None:
        """Turn by an angle [rad], counter-clockwise, more than once around if need be.

        The rest is as for ``move_l``.
        """
        rows = self._begin(robots, timeout, angle)
        self._straight[rows], self._relative[rows] = False, True
        self._heading[rows] = angle

    def move_ofsc(
        self, heading: ArrayLike, robots: ArrayLike | None = None, *, timeout: float = 60.0
    ) -> None:
        """Turn to an absolute heading [rad], in the shorter direction.

        The rest is as for ``move_l``.
        """
        rows = self._begin(robots, timeout, heading)
        self._straight[rows], self._relative[rows] = False, False
        self._heading[rows] = heading

    def cancel(self, robots: ArrayLike | None = None) -> None:
        """Cancel the motions of these robots, all if None; the next update stops them."""
        rows = self._rows(robots)
        moving = rows[self.outcome[rows] == Outcome.MOVING]
        self.outcome[moving] = Outcome.CANCELLED

    def update(self, poses: ArrayLike, time: float) -> Floats:
        """Return the velocity commands for now.

        Args:
            poses: x, y [m] and heading [rad], shape (count, 3).
            time: Simulated [s]; the first update of a motion starts its time.

        Returns:
            Forward speed [m/s] and yaw rate [rad/s], shape (count, 2); 0 without a motion.

        Raises:
            ControlError: The poses have the wrong shape.
        """
        pose = np.asarray(poses, np.float64)
        if pose.shape != (self.count, 3):
            raise ControlError(f"poses have shape {pose.shape}, expected ({self.count}, 3)")
        dt = 0.0 if not time > self._last else time - self._last
        if time < self._last:  # time began again: what motions took so far still counts
            self._start += time - self._last
        self._last = time
        command = np.zeros((self.count, 2))
        rows = np.flatnonzero(self.active)
        fresh = rows[np.isnan(self._start[rows])]
        self._start[fresh] = time
        self.taken[rows] = time - self._start[rows]
        straight = self._straight[rows]
        still = self._still(pose)
        self._turn(rows[~straight], pose, dt, command, still)
        self._go(rows[straight], pose, dt, command, still)
        self._before[:] = pose
        late = rows[self.active[rows] & (self.taken[rows] >= self._limit[rows])]
        self.outcome[late], command[late] = Outcome.TIMED_OUT, 0.0
        return command

    def _still(self, pose: Floats) -> NDArray[np.bool_]:
        """Return a mask of robots that hardly moved since the last update, shape (count,).

        Only a standing robot has arrived: where time runs faster than commands travel, a robot may
        be seen at the goal in passing.
        """
        moved = np.abs(pose - self._before)
        moved[:, 2] = np.abs(wrapped(pose[:, 2] - self._before[:, 2]))
        least = self.limits.distance, self.limits.distance, self.limits.angle
        still: NDArray[np.bool_] = (moved < _STANDS * np.array(least)).all(axis=1)
        return still

    def _turn(
        self, rows: Indices, pose: Floats, dt: float, command: Floats, still: NDArray[np.bool_]
    ) -> None:
        heading = pose[rows, 2]
        relative = self._relative[rows]
        error = wrapped(self._heading[rows] - heading)
        if relative.any():
            # What is left to turn is counted down, so that it may be more than half around.
            last = self._turned[rows]
            done = np.where(np.isnan(last), 0.0, wrapped(heading - last))
            self._turned[rows] = heading
            by = rows[relative]
            self._heading[by] -= done[relative]
            error[relative] = self._heading[by]
        self._finish(rows[(np.abs(error) <= self.limits.angle) & still[rows]])
        left = np.abs(error) > self.limits.angle
        command[rows[left], 1] = self._pid.update(error[left], dt, rows[left])

    def _go(
        self, rows: Indices, pose: Floats, dt: float, command: Floats, still: NDArray[np.bool_]
    ) -> None:
        limits = self.limits
        offset = self._goal[rows] - pose[rows, :2]
        distance = np.hypot(offset[:, 0], offset[:, 1])
        there = distance <= limits.distance
        self._finish(rows[there & still[rows]])
        error = wrapped(np.arctan2(offset[:, 1], offset[:, 0]) - pose[rows, 2])
        # While approaching, a robot that has passed the point backs up and does not turn round.
        approaching = self._aligned[rows] & (distance < 0.25)
        error = np.where(approaching & (np.cos(error) < 0.0), wrapped(error + math.pi), error)
        back = approaching & (
            offset[:, 0] * np.cos(pose[rows, 2]) + offset[:, 1] * np.sin(pose[rows, 2]) < 0
        )
        aligned = np.abs(error) <= limits.turn_first
        self._aligned[rows] |= aligned
        speed = np.minimum(limits.gain * distance, limits.linear) * np.where(back, -1.0, 1.0)
        speed = np.where(aligned, speed * np.cos(error), 0.0)
        turning = self._pid.update(error, dt, rows)
        # Near the point its bearing is unreliable: only what aims past the tolerance counts.
        small = np.abs(distance * np.sin(error)) < 0.5 * limits.distance
        command[rows, 0] = np.where(there, 0.0, speed)
        command[rows, 1] = np.where(there | (small & (distance < 0.25) & aligned), 0.0, turning)

    def _finish(self, rows: Indices) -> None:
        self.outcome[rows] = Outcome.REACHED

    def _begin(self, robots: ArrayLike | None, timeout: float, *values: ArrayLike) -> Indices:
        rows = self._rows(robots)
        for value in values:
            if not np.isfinite(np.asarray(value, np.float64)).all():
                raise ControlError(f"a motion needs finite numbers, not {value!r}")
        if not timeout > 0.0:
            raise ControlError(f"the timeout of a motion must be positive, not {timeout} s")
        self.outcome[rows], self.taken[rows] = Outcome.MOVING, 0.0
        self._limit[rows], self._start[rows], self._turned[rows] = timeout, math.nan, math.nan
        self._pid.reset(rows)
        return rows

    def _rows(self, robots: ArrayLike | None) -> Indices:
        if robots is None:
            return np.arange(self.count)
        rows = np.atleast_1d(np.asarray(robots, np.intp))
        if rows.size and (rows.min() < 0 or rows.max() >= self.count):
            raise ControlError(f"robots must be 0 to {self.count - 1}, not {robots!r}")
        return rows


def wrapped(angle: ArrayLike) -> Floats:
    """Return the same angle [rad] in (-pi, pi].

    Unlike `gazelle.navigation.angles.wrapped_all` it has pi for -pi, and other last bits, with which the
    published fleets were trained.
    """
    around: Floats = np.pi - np.mod(np.pi - np.asarray(angle, np.float64), 2.0 * np.pi)
    return around
