"""Times of the points of a path: within limits of velocity and acceleration, at rest at both ends."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np

from gazelle.argument_checks import checked
from gazelle.array_types import Floats
from gazelle.errors import PlanningError
from gazelle.planning.blended_path import PathPieces, blended
from gazelle.planning.limits import checked_duration
from gazelle.planning.parabolic_timing import iterative_parabolic
from gazelle.planning.path_timing import SpeedProfile

TimeAlgorithm = Literal["time optimal", "iterative parabolic"]

DEFAULT_VELOCITY = 1.0
"""Of joints that have no limit, as in MoveIt [m/s or rad/s]."""
DEFAULT_ACCELERATION = 1.0
"""Likewise [m/s² or rad/s²]."""
PATH_TOLERANCE = 0.1
"""Largest deviation by rounding of corners, as in MoveIt."""
RESAMPLE = 0.05
"""Time between the points of a trajectory [s]."""
_STEPS = 300
_EQUAL = 1e-7
_CORNER = 1e-5
_JUMP = 0.02
"""Changes of acceleration, as a part of the greatest one, that get a point of their own."""


@checked(PlanningError, most=math.inf)
@dataclass(frozen=True, slots=True)
class PathLimits:
    """Limits of joints for timing a path.

    Attributes:
        velocity: [m/s or rad/s], above zero, shape (n,).
        acceleration: [m/s² or rad/s²], above zero, shape (n,).
    """

    velocity: Floats
    acceleration: Floats

    def scaled(self, velocity: float, acceleration: float) -> PathLimits:
        """Return limits times factors within (0, 1].

        Raises:
            PlanningError: A factor is not within.
        """
        for name, value in (("velocity", velocity), ("acceleration", acceleration)):
            if not 0.0 < value <= 1.0:
                raise PlanningError(
                    f"the scaling factor of {name} must be within (0, 1], not {value!r}"
                )
        known = np.where(np.isfinite(self.velocity), self.velocity, DEFAULT_VELOCITY)
        bounded = np.where(np.isfinite(self.acceleration), self.acceleration, DEFAULT_ACCELERATION)
        return PathLimits(known * velocity, bounded * acceleration)


@checked(PlanningError)
@dataclass(frozen=True, slots=True)
class TimedPath:
    """A trajectory of joints.

    Attributes:
        times: Since the start [s], rising from 0, shape (m,).
        positions: [m or rad], shape (m, n).
        velocities: [m/s or rad/s], zero at both ends, shape (m, n).
        accelerations: [m/s² or rad/s²], shape (m, n).
    """

    times: Floats
    positions: Floats
    velocities: Floats
    accelerations: Floats

    @property
    def duration(self) -> float:
        """Duration [s]."""
        return float(self.times[-1])

    def slower(self, factor: float) -> TimedPath:
        """Return the same path with its times scaled by a factor."""
        return TimedPath(
            self.times * factor,
            self.positions,
            self.velocities / factor,
            self.accelerations / factor**2,
        )


@checked(PlanningError)
def parameterize(
    points: Floats,
    limits: PathLimits,
    algorithm: TimeAlgorithm = "time optimal",
    *,
    tolerance: float = PATH_TOLERANCE,
) -> TimedPath:
    """Return a trajectory along a path, within limits.

    Args:
        points: On the path, shape (m, n).
        limits: Of the joints, finite.
        algorithm: ``time optimal``: as fast as the limits let it be, corners rounded off, points at
            equal times; ``iterative parabolic``: through the points themselves, slower.
        tolerance: Largest deviation at corners.

    Raises:
        PlanningError: There is no point, the algorithm is unknown, or the motion takes too long.
    """
    if algorithm not in get_args(TimeAlgorithm):
        raise PlanningError(f"there is no time parameterization '{algorithm}'")
    if len(points) == 0:
        raise PlanningError("a path without points has no times")
    moved = np.linalg.norm(np.diff(points, axis=0), axis=1) > _EQUAL
    kept = points[np.concatenate(([True], moved))]
    if len(kept) < 2:
        still = np.zeros_like(kept)
        return TimedPath(np.zeros(1), kept, still, still)
    if algorithm == "time optimal":
        return _within(_time_optimal(blended(kept, tolerance), limits), limits)
    times = iterative_parabolic(kept, limits.velocity, limits.acceleration)
    return _within(_through(times, kept), limits)


def _time_optimal(path: PathPieces, limits: PathLimits) -> TimedPath:
    """Return the fastest trajectory along a path, sampled."""
    places = _places(path)
    _, slopes, bends = path.at(np.append((places[:-1] + places[1:]) / 2.0, places[-1]))
    profile = SpeedProfile(places, slopes, bends, limits.velocity, limits.acceleration)
    squares = profile.squares(_ceilings(path, places))
    speeds = np.sqrt(squares)
    lengths = np.diff(places)
    spans = 2.0 * lengths / np.maximum(speeds[1:] + speeds[:-1], 1e-9 * path.length)
    moments = np.concatenate(([0.0], np.cumsum(spans)))
    pushes = np.diff(squares) / (2.0 * lengths)
    times = _moments(moments, pushes)
    index = np.clip(np.searchsorted(moments, times, "right") - 1, 0, len(spans) - 1)
    since = times - moments[index]
    push = pushes[index]
    place = np.minimum(places[index] + speeds[index] * since + 0.5 * push * since**2, path.length)
    speed = speeds[index] + push * since
    place[-1], speed[-1] = path.length, 0.0
    positions, slope, bend = path.at(place)
    velocities = slope * speed[:, None]
    accelerations = slope * push[:, None] + bend * (speed**2)[:, None]
    velocities[0] = velocities[-1] = 0.0
    return TimedPath(times, positions, velocities, accelerations)


def _places(path: PathPieces) -> Floats:
    """Return the places where speeds are computed: ends of pieces, and some within each."""
    counts = np.maximum(4, np.ceil(_STEPS * np.diff(path.begins) / path.length)).astype(int)
    parts = [
        np.linspace(first, second, count, endpoint=False)
        for first, second, count in zip(path.begins[:-1], path.begins[1:], counts, strict=True)
    ]
    return np.append(np.concatenate(parts), path.length)


def _ceilings(path: PathPieces, places: Floats) -> Floats:
    """Return squares of the speed that corners allow: zero where the direction jumps."""
    ceilings = np.full(len(places), np.inf)
    ceilings[-1] = 0.0
    inner = path.begins[1:-1]
    _, before, _ = path.at(inner - 1e-9 * path.length)
    _, after, _ = path.at(inner)
    corners = inner[np.linalg.norm(after - before, axis=1) > _CORNER]
    ceilings[np.isin(places, corners)] = 0.0
    return ceilings


def _moments(moments: Floats, pushes: Floats) -> Floats:
    """Return times of the result: uniform ones, and those where the acceleration jumps."""
    end = float(moments[-1])
    even = np.linspace(0.0, end, max(3, checked_duration(end, RESAMPLE) + 1))
    gap = float(even[1])
    jumps = moments[1:-1][np.abs(np.diff(pushes)) > _JUMP * np.abs(pushes).max()]
    jumps = jumps[(jumps > gap / 20.0) & (jumps < end - gap / 20.0)]
    jumps = jumps[np.diff(jumps, prepend=-gap) > gap / 20.0]
    if len(jumps):
        away = np.abs(even[:, None] - jumps).min(axis=1)
        away[[0, -1]] = gap
        even = even[away > gap / 4.0]
    return np.sort(np.concatenate((even, jumps)))


def _through(times: Floats, points: Floats) -> TimedPath:
    """Return velocities and accelerations at timed points: of parabolas through neighbours."""
    spans = np.diff(times)[:, None]
    rates = np.diff(points, axis=0) / spans
    velocities = np.zeros_like(points)
    velocities[1:-1] = (rates[:-1] * spans[1:] + rates[1:] * spans[:-1]) / (spans[:-1] + spans[1:])
    accelerations = np.zeros_like(points)
    accelerations[1:-1] = 2.0 * (rates[1:] - rates[:-1]) / (spans[:-1] + spans[1:])
    accelerations[0] = 2.0 * rates[0] / spans[0]
    accelerations[-1] = -2.0 * rates[-1] / spans[-1]
    return TimedPath(times, points, velocities, accelerations)


def _within(made: TimedPath, limits: PathLimits) -> TimedPath:
    """Return the trajectory slowed down to limits, at its points and on cubics between them."""
    spans = np.diff(made.times)[:, None]
    rates = np.diff(made.positions, axis=0) / spans
    before, after = made.velocities[:-1], made.velocities[1:]
    ends = np.concatenate(
        (
            (6.0 * rates - 4.0 * before - 2.0 * after) / spans,
            (2.0 * before + 4.0 * after - 6.0 * rates) / spans,
            made.accelerations,
        )
    )
    # The velocity of a cubic is v0 + b s + c s^2, greatest where that has no slope.
    b, c = 6.0 * rates - 4.0 * before - 2.0 * after, 3.0 * (before + after) - 6.0 * rates
    top = np.clip(-b / np.where(np.abs(c) > _EQUAL**2, 2.0 * c, np.inf), 0.0, 1.0)
    peaks = before + top * (b + top * c)
    speed = np.abs(np.concatenate((made.velocities, peaks))).max(axis=0) / limits.velocity
    push = np.abs(ends).max(axis=0) / limits.acceleration
    factor = max(1.0, float(speed.max()), math.sqrt(float(push.max())))
    return made if factor == 1.0 else made.slower(factor * (1.0 + 1e-9))
