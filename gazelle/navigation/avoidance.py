"""Do not run into what the laser sees: the nearest velocity that can still be stopped."""

from __future__ import annotations

import math
from typing import cast

import numpy as np

from gazelle.array_types import Floats
from gazelle.navigation.limits import BaseLimits

_LINEAR_CHOICES = 7
_ANGULAR_CHOICES = 13
_MOMENTS = 7
_REACTION = 0.15  # time that passes before a base brakes [s]
_ROOM = 0.25  # distance within which being near costs [m]


def safe_velocity(
    desired: tuple[float, float],
    now: tuple[float, float],
    points: Floats,
    interval: float,
    limits: BaseLimits,
) -> tuple[float, float]:
    """Return the velocity nearest to the desired one that hits nothing before the base stands.

    Only velocities that can be had within the interval are tried: the dynamic window of
    D. Fox, W. Burgard and S. Thrun, "The dynamic window approach to collision avoidance",
    1997. If all hit something, the base brakes.

    Args:
        desired: Forward [m/s] and turning [rad/s].
        now: The same, as it moves.
        points: Obstacles in the frame of the base (x, y) [m], shape (n, 2).
        interval: Until the next command [s].
        limits: Of the base.
    """
    gain, turn = limits.linear_acceleration * interval, limits.angular_acceleration * interval
    low, high = max(now[0] - gain, 0.0), min(max(now[0], 0.0) + gain, limits.linear)
    speeds = _choices(desired[0], min(low, high), high, _LINEAR_CHOICES)
    least, most = max(now[1] - turn, -limits.angular), min(now[1] + turn, limits.angular)
    turns = _choices(desired[1], min(least, most), max(least, most), _ANGULAR_CHOICES)
    tried = np.stack(np.meshgrid(speeds, turns, indexing="ij"), axis=-1).reshape(-1, 2)
    room, already = _room(tried, points, interval, limits)
    # In a place that is too narrow already, what does not make it narrower may be done.
    open_to = room >= min(limits.clearance / 2.0, already - 1e-3)
    if not open_to.any():
        return min(low, high), float(np.clip(0.0, least, most))
    off = np.abs(tried - desired) @ (1.0 / limits.linear, 0.5 / limits.angular)
    cost = off + 0.6 * np.clip(1.0 - room / _ROOM, 0.0, 1.0)
    best = tried[np.where(open_to, cost, math.inf).argmin()]
    return float(best[0]), float(best[1])


def _choices(desired: float, low: float, high: float, count: int) -> Floats:
    """Return values of a range, with the one nearest to the desired value.

    Zero is among them if the range contains it.
    """
    special = np.clip((desired, 0.0), low, high)
    return np.unique(np.concatenate((np.linspace(low, high, count), special)))


def _room(
    tried: Floats, points: Floats, interval: float, limits: BaseLimits
) -> tuple[Floats, float]:
    """Return the least distance of the base's rim to obstacles until it stops [m], by velocity.

    Also what it is now. Stopping takes the reaction, the interval and the braking.
    """
    reach = limits.linear**2 / limits.linear_acceleration + limits.radius + 1.0
    distances = np.hypot(points[:, 0], points[:, 1])
    points = points[distances < reach]
    if not len(points):
        return np.full(len(tried), reach), reach
    speed, turning = tried[:, 0], tried[:, 1]
    lasting = _REACTION + interval + speed / (2.0 * limits.linear_acceleration)
    moments = lasting[:, None] * np.linspace(1.0 / _MOMENTS, 1.0, _MOMENTS)
    angle = turning[:, None] * moments
    # A straight line is an arc of hardly any turning; sinc keeps its length.
    chord = speed[:, None] * moments * np.sinc(angle / (2.0 * np.pi))
    x, y = chord * np.cos(angle / 2.0), chord * np.sin(angle / 2.0)
    dx = x[:, :, None] - points[:, 0]
    dy = y[:, :, None] - points[:, 1]
    nearest = np.sqrt((dx * dx + dy * dy).min(axis=(1, 2)))
    already = float(distances.min()) - limits.radius
    return cast("Floats", nearest - limits.radius), already
