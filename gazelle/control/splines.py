"""Segments of trajectories: polynomials between two states, as joint_trajectory_controller has them."""

from __future__ import annotations

import math

import numpy as np

from gazelle.array_types import Bools, Floats


def coefficients(
    duration: Floats, start: tuple[Floats, Floats, Floats], end: tuple[Floats, Floats, Floats]
) -> Floats:
    """Return polynomials of rising powers of the time since the start, shape (..., 6).

    They are linear where an end has no velocity, cubic where both have, quintic where both have
    accelerations too; missing values are NaN. One that lasts no time holds its start.

    Args:
        duration: [s], shape (...) or what broadcasts to it.
        start: Position, velocity and acceleration, shape (...).
        end: Likewise.
    """
    p0, v0, a0 = start
    p1, v1, a1 = end
    moving = ~(np.isnan(v0) | np.isnan(v1))
    bent = moving & ~(np.isnan(a0) | np.isnan(a1))
    shape = np.broadcast_shapes(*(np.shape(each) for each in (duration, p0, p1, v0, v1)))
    found = np.zeros((*shape, 6))
    lasting = np.broadcast_to(duration > 0.0, shape)
    t = np.where(lasting, duration, 1.0)
    v0, v1 = np.where(moving, v0, 0.0), np.where(moving, v1, 0.0)
    a0, a1 = np.where(bent, a0, 0.0), np.where(bent, a1, 0.0)
    rise = p1 - p0
    cubic = (
        v0,
        (3.0 * rise - (2.0 * v0 + v1) * t) / t**2,
        (-2.0 * rise + (v0 + v1) * t) / t**3,
        np.zeros(shape),
        np.zeros(shape),
    )
    quintic = (
        v0,
        0.5 * a0,
        (20.0 * rise - (12.0 * v0 + 8.0 * v1) * t - (3.0 * a0 - a1) * t**2) / (2.0 * t**3),
        (-30.0 * rise + (16.0 * v0 + 14.0 * v1) * t + (3.0 * a0 - 2.0 * a1) * t**2) / (2.0 * t**4),
        (12.0 * rise - 6.0 * (v0 + v1) * t + (a1 - a0) * t**2) / (2.0 * t**5),
    )
    found[..., 0] = p0
    for power, (third, fifth) in enumerate(zip(cubic, quintic, strict=True), 1):
        line = rise / t if power == 1 else 0.0
        value = np.where(bent, fifth, np.where(moving, third, line))
        found[..., power] = np.where(lasting, value, 0.0)
    return found


def evaluate(polynomials: Floats, time: Floats, inside: Bools) -> tuple[Floats, Floats, Floats]:
    """Return positions, velocities and accelerations, each of shape (...).

    Args:
        polynomials: From ``coefficients``, powers first, shape (6, ...).
        time: Since their start, within their duration [s], shape (...).
        inside: Mask of those at the requested time; elsewhere they stand still, shape (...).
    """
    c, t = polynomials, time
    position = c[0] + t * (c[1] + t * (c[2] + t * (c[3] + t * (c[4] + t * c[5]))))
    velocity = c[1] + t * (2 * c[2] + t * (3 * c[3] + t * (4 * c[4] + t * 5 * c[5])))
    acceleration = 2 * c[2] + t * (6 * c[3] + t * (12 * c[4] + t * 20 * c[5]))
    return position, velocity * inside, acceleration * inside


def wrap_offset(before: Floats, after: Floats) -> Floats:
    """Return the offsets of positions with which joints that turn endlessly go the shorter way.

    At half a turn the way that the positions say is taken.

    Args:
        before: Start positions [rad].
        after: End positions [rad].
    """
    turn = np.mod(after - before + math.pi, 2.0 * math.pi) - math.pi
    half = np.abs(np.abs(turn) - math.pi) < 1e-9
    turn = np.where(half, np.where(after > before, math.pi, -math.pi), turn)
    return before + turn - after
