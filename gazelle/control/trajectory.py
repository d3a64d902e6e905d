"""Trajectories of joints in many worlds: segments by time, and how a new one takes over.

Each joint of each world has segments of its own, as a trajectory may be of some of them only. The segment
that acts is the last one that has begun; after its end it holds its last position.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Bools, Floats, Indices, Ints64, Worlds
from gazelle.control.splines import coefficients, evaluate, wrap_offset

N = TypeVar("N", bound=np.generic)


@dataclass(frozen=True, slots=True)
class Waypoints:
    """Points to go through; missing velocities and accelerations are NaN.

    Attributes:
        times: On the controller's clock [s], rising, shape (k,).
        positions: [m or rad], shape (k, n) of n joints.
        velocities: Likewise.
        accelerations: Likewise.
        joints: Joints, columns of the controller's, shape (n,).
    """

    times: Floats
    positions: Floats
    velocities: Floats
    accelerations: Floats
    joints: Indices


@dataclass(frozen=True, slots=True)
class TrajectorySample:
    """A moment of a trajectory; shapes (nworld, joints).

    Attributes:
        position: [m or rad].
        velocity: [m/s or rad/s].
        acceleration: [m/s² or rad/s²].
        end: End of the segment [s].
        last: Whether it is the last one.
        goal: Number of the goal that it belongs to; 0 for none.
    """

    position: Floats
    velocity: Floats
    acceleration: Floats
    end: Floats
    last: Bools
    goal: Ints64


class TrajectoryTable:
    """The segments of all joints in all worlds; columns are segments, in the order of their times.

    Args:
        nworld: Number of worlds.
        joints: Number of joints.
        endless: Mask of joints without limits, shape (joints,).

    Attributes:
        followers: Called with all segments whenever there are others.
    """

    def __init__(self, nworld: int, joints: int, endless: Bools) -> None:
        self._endless = endless
        self._kept: _Acting | None = None
        self.start: Floats = np.zeros((nworld, joints, 1))
        self.duration: Floats = np.zeros((nworld, joints, 1))
        self.polynomials: Floats = np.zeros((nworld, joints, 1, 6))
        self.goal: Ints64 = np.zeros((nworld, joints, 1), np.int64)
        self.followers: list[Callable[[Floats, Floats, Floats, Ints64], None]] = []

    def notify(self) -> None:
        """Send all segments to their followers."""
        self._kept = None
        for each in self.followers:
            each(self.start, self.duration, self.polynomials, self.goal)

    def _active(self, time: float, rows: Worlds | slice) -> Indices:
        """Return columns of the active segments, shape (n, joints).

        The first one before its time.
        """
        start = self.start[rows]
        begun = np.where(start <= time, start, -math.inf)
        latest = start.shape[2] - 1 - np.argmax(begun[:, :, ::-1], axis=2)
        none = np.isneginf(begun).all(axis=2)
        first = np.argmax(np.isfinite(start), axis=2)
        column: Indices = np.where(none, first, latest)
        return column

    def _acting(self, time: float, rows: Worlds | None) -> _Acting:
        """Return the active segments at a time.

        Those of all worlds are cached until others start.
        """
        kept = self._kept
        if rows is None and kept is not None and kept.since <= time < kept.until:
            return kept
        chosen: Worlds | slice = slice(None) if rows is None else rows
        start = self.start[chosen]
        column = self._active(time, chosen)
        place = column[:, :, None]
        begin = np.take_along_axis(start, place, 2)[:, :, 0]
        duration = np.take_along_axis(self.duration[chosen], place, 2)[:, :, 0]
        polynomials = np.take_along_axis(self.polynomials[chosen], place[..., None], 2)[:, :, 0]
        later = start[start > time]
        acting = _Acting(
            time,
            float(later.min()) if later.size else math.inf,
            begin,
            duration,
            begin + duration,
            np.ascontiguousarray(np.moveaxis(polynomials, -1, 0)),
            column == start.shape[2] - 1,
            np.take_along_axis(self.goal[chosen], place, 2)[:, :, 0],
        )
        if rows is None:
            self._kept = acting
        return acting

    def sample(self, time: float, rows: Worlds | None = None) -> TrajectorySample:
        """Return the desired positions of joints at a time.

        Args:
            time: On the controller's clock [s].
            rows: Worlds; all if None.
        """
        acting = self._acting(time, rows)
        since = time - acting.begin
        inside = (since >= 0.0) & (since <= acting.duration)
        within = np.minimum(np.maximum(since, 0.0), acting.duration)
        moments = evaluate(acting.polynomials, within, inside)
        return TrajectorySample(*moments, acting.end, acting.last, acting.goal)

    def begins(self) -> Floats:
        """Return the start of each world's first segment [s], shape (nworld,)."""
        earliest: Floats = self.start.min(axis=(1, 2))
        return earliest

    def hold(self, time: float, position: Floats, rows: Worlds) -> None:
        """Hold positions from now on.

        Args:
            time: Now [s].
            position: Positions to hold, shape (n, joints).
            rows: Worlds, shape (n,).
        """
        shape = (*position.shape, 1)
        polynomials = np.zeros((*shape, 6))
        polynomials[:, :, 0, 0] = position
        zero = np.zeros(shape)
        self._store(rows, zero + time, zero, polynomials, np.zeros(shape, np.int64))

    def ramp(self, time: float, duration: float, rows: Worlds) -> None:
        """Ramp to rest: start at the present command, on the first half of a way there and back.

        Args:
            time: Now [s].
            duration: [s].
            rows: Worlds, shape (n,).
        """
        now = self.sample(time, rows)
        zero = np.zeros_like(now.position)
        there = coefficients(
            np.array(2.0 * duration),
            (now.position, now.velocity, zero),
            (now.position, -now.velocity, zero),
        )
        middle, _, bend = evaluate(
            np.moveaxis(there, -1, 0), zero + duration, np.ones(zero.shape, bool)
        )
        half = coefficients(
            np.array(duration), (now.position, now.velocity, zero), (middle, zero, bend)
        )
        shape = (*zero.shape, 1)
        self._store(
            rows,
            np.full(shape, time),
            np.full(shape, duration),
            half[:, :, None],
            np.zeros(shape, np.int64),
        )

    def follow(self, points: Waypoints, now: float, begin: float, goal: int, rows: Worlds) -> None:
        """Follow other points.

        What was followed continues until they begin; a segment leads from there to the first point.
        Joints that the points are not of continue as before.

        Args:
            points: Points of the trajectory; all after now.
            now: Of the next update [s].
            begin: Start time [s].
            goal: Number of the goal that they are of; 0 for none.
            rows: Worlds, shape (n,).
        """
        change = max(begin, now)
        joints = points.joints
        at = self.sample(change, rows)
        state = tuple(each[:, joints] for each in (at.position, at.velocity, at.acceleration))
        shift = wrap_offset(state[0], np.broadcast_to(points.positions[0], state[0].shape))
        shift = np.where(self._endless[joints], shift, 0.0)[:, :, None]
        ends = tuple(each.T for each in (points.positions, points.velocities, points.accelerations))
        desired = (ends[0] + shift, *(np.broadcast_to(e, (len(rows), *e.shape)) for e in ends[1:]))
        starts = tuple(
            np.concatenate((first[:, :, None], later[:, :, :-1]), axis=2)
            for first, later in zip(state, desired, strict=True)
        )
        times = np.concatenate(([change], points.times[:-1]))
        lasts = np.maximum(points.times - times, 0.0)
        polynomials = coefficients(lasts, _three(starts), _three(desired))
        self._join(points, _New(times, lasts, polynomials, goal), now, change, rows)

    def _join(self, points: Waypoints, new: _New, now: float, change: float, rows: Worlds) -> None:
        """Append the new segments to the rest of the old ones."""
        count, joints = len(rows), self.start.shape[1]
        old, added = self.start.shape[2], len(points.times)
        first = self._active(now, rows)
        last = np.where(
            np.isin(np.arange(joints), points.joints),
            self._active(change, rows),
            old - 1,
        )
        # Old segments stand right of what is free, so that the last column is the last segment.
        room = np.full(joints, added)
        room[np.setdiff1d(np.arange(joints), points.joints)] = 0
        width = int(max((last - first + 1 + room).max(), added))
        column = np.arange(width) - (width - room[None, :, None]) + last[:, :, None] + 1
        column = np.broadcast_to(column, (count, joints, width))
        kept = (column >= first[:, :, None]) & (column <= last[:, :, None])
        place = np.clip(column, 0, old - 1)
        start = np.where(kept, np.take_along_axis(self.start[rows], place, 2), math.inf)
        duration = np.where(kept, np.take_along_axis(self.duration[rows], place, 2), 0.0)
        polynomials = np.take_along_axis(self.polynomials[rows], place[..., None], 2)
        goals = np.where(kept, np.take_along_axis(self.goal[rows], place, 2), 0)
        begin = width - added
        for number, joint in enumerate(points.joints.tolist()):
            start[:, joint, begin:] = new.times
            duration[:, joint, begin:] = new.durations
            polynomials[:, joint, begin:] = new.polynomials[:, number]
            goals[:, joint, begin:] = new.goal
        self._store(rows, start, duration, polynomials, goals)

    def _store(
        self, rows: Worlds, start: Floats, duration: Floats, polynomials: Floats, goal: Ints64
    ) -> None:
        """Store the segments of some worlds, with as many columns as all of them need."""
        if len(rows) < len(self.start):
            width = max(start.shape[2], self.start.shape[2])
            start = _merged(self.start, rows, start, width, math.inf)
            duration = _merged(self.duration, rows, duration, width, 0)
            polynomials = _merged(self.polynomials, rows, polynomials, width, 0)
            goal = _merged(self.goal, rows, goal, width, 0)
        spare = int(np.argmax(np.isfinite(start).any(axis=(0, 1))))
        self.start, self.duration = start[:, :, spare:].copy(), duration[:, :, spare:].copy()
        self.polynomials, self.goal = polynomials[:, :, spare:].copy(), goal[:, :, spare:].copy()
        self.notify()

    def _arrays(self) -> tuple[NDArray[np.generic], ...]:
        return (self.start, self.duration, self.polynomials, self.goal)

    def state(self) -> dict[str, NDArray[np.generic]]:
        """Return all segments."""
        names = ("start", "duration", "polynomials", "goal")
        return {name: each.copy() for name, each in zip(names, self._arrays(), strict=True)}

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        self.start = np.array(state["start"], np.float64)
        self.duration = np.array(state["duration"], np.float64)
        self.polynomials = np.array(state["polynomials"], np.float64)
        self.goal = np.array(state["goal"], np.int64)
        self.notify()


@dataclass(frozen=True, slots=True)
class _Acting:
    """The segments that act from a time until another [s]: shapes (n, joints), polynomials (6, n, joints)."""

    since: float
    until: float
    begin: Floats
    duration: Floats
    end: Floats
    polynomials: Floats
    last: Bools
    goal: Ints64


@dataclass(frozen=True, slots=True)
class _New:
    """Segments of the joints of a message: times (k,), polynomials (n, joints, k, 6)."""

    times: Floats
    durations: Floats
    polynomials: Floats
    goal: int


def _three(each: tuple[Floats, ...]) -> tuple[Floats, Floats, Floats]:
    position, velocity, acceleration = each
    return position, velocity, acceleration


def _merged(
    all_rows: NDArray[N], rows: Worlds, given: NDArray[N], width: int, filler: float
) -> NDArray[N]:
    """Return all rows with some of them new, each with free columns before its own."""
    merged = _widened(all_rows, width, filler)
    merged[rows] = _widened(given, width, filler)
    return merged


def _widened(values: NDArray[N], width: int, filler: float) -> NDArray[N]:
    wide = np.full((*values.shape[:2], width, *values.shape[3:]), filler, values.dtype)
    wide[:, :, width - values.shape[2] :] = values
    return wide
