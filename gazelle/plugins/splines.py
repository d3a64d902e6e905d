"""Poses between key frames, as Gazebo interpolates them.

Positions are on a cubic Hermite spline with the tangents of a cardinal spline,
``(1 - tension) / 2 * (p[i + 1] - p[i - 1])``, each leg taken from 0 to 1 however long it lasts.
Orientations are on Shoemake's spline of four quaternions (Quaternion Calculus for Computer
Animation, 1987). A path that ends where it begins goes through there smoothly.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats
from gazelle.errors import SimulationError
from gazelle.rotations import conjugate, multiply

# Quaternions this near to each other are mixed evenly: their angle is too small to divide by.
_NEAR = 1e-3


class PoseSpline:
    """A path through poses at times.

    Args:
        times: Rising [s], shape (k,), k at least 1.
        positions: [m], shape (k, 3).
        quaternions: (x, y, z, w), shape (k, 4).
        tension: 0 for the roundest path, 1 to stop at every pose.

    Raises:
        SimulationError: The times do not rise.
    """

    def __init__(
        self, times: Floats, positions: Floats, quaternions: Floats, tension: float = 0.0
    ) -> None:
        if (np.diff(times) <= 0.0).any():
            raise SimulationError("the times of waypoints must increase")
        self._times, self._positions, self._quaternions = times, positions, quaternions
        before, after = _neighbours(positions)
        self._tangents = 0.5 * (1.0 - tension) * (positions[after] - positions[before])
        before, after = _neighbours(quaternions)
        back = conjugate(quaternions)
        bend = _log(multiply(back, quaternions[after])) + _log(multiply(back, quaternions[before]))
        self._controls = multiply(quaternions, _exp(-0.25 * bend))

    @property
    def duration(self) -> float:
        """Time of the last pose [s]."""
        return float(self._times[-1])

    def at(self, moments: Floats) -> tuple[Floats, Floats]:
        """Return positions (n, 3) and quaternions (n, 4) at some times [s], shape (n,).

        Before the first pose it is there, after the last it stays there.
        """
        held = np.clip(moments, self._times[0], self._times[-1])
        leg = np.searchsorted(self._times[1:-1], held, side="right")
        end = np.minimum(leg + 1, len(self._times) - 1)
        span = np.maximum(self._times[end] - self._times[leg], 1e-300)
        share = ((held - self._times[leg]) / span)[:, None]
        return self._position(leg, end, share), self._orientation(leg, end, share)

    def _position(self, leg: NDArray[np.intp], end: NDArray[np.intp], t: Floats) -> Floats:
        rise = t * t * (3.0 - 2.0 * t)
        points = (1.0 - rise) * self._positions[leg] + rise * self._positions[end]
        leave, arrive = t * (1.0 - t) ** 2, t * t * (t - 1.0)
        moved: Floats = points + leave * self._tangents[leg] + arrive * self._tangents[end]
        return moved

    def _orientation(self, leg: NDArray[np.intp], end: NDArray[np.intp], t: Floats) -> Floats:
        outer = _slerp(t, self._quaternions[leg], self._quaternions[end], shortest=True)
        inner = _slerp(t, self._controls[leg], self._controls[end])
        return _slerp(2.0 * t * (1.0 - t), outer, inner)


def _neighbours(points: Floats) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Return the indices before and after each point: the ends have themselves, or wrap around."""
    count = len(points)
    before, after = np.arange(count) - 1, np.arange(count) + 1
    closed = count > 1 and np.array_equal(points[0], points[-1])
    before[0] = count - 2 if closed else 0
    after[-1] = 1 if closed else count - 1
    return before, after


def _log(q: Floats) -> Floats:
    """Return half the turn of unit quaternions as vectors, shape (n, 3)."""
    size = np.linalg.norm(q[:, :3], axis=1)
    angle = np.arccos(np.clip(q[:, 3], -1.0, 1.0))
    scale = np.where(size >= _NEAR, angle / np.maximum(size, _NEAR), 1.0)
    return q[:, :3] * scale[:, None]


def _exp(half: Floats) -> Floats:
    """Return unit quaternions of half turns, shape (n, 4)."""
    angle = np.linalg.norm(half, axis=1, keepdims=True)
    return np.concatenate((half * np.sinc(angle / np.pi), np.cos(angle)), axis=1)


def _slerp(t: Floats, first: Floats, last: Floats, *, shortest: bool = False) -> Floats:
    """Return the slerp between two orientations, on the great circle; ``t`` has shape (n, 1)."""
    cosine = np.einsum("ni,ni->n", first, last)[:, None]
    if shortest:
        last = np.where(cosine < 0.0, -last, last)
        cosine = np.abs(cosine)
    near = np.abs(cosine) >= 1.0 - _NEAR
    angle = np.arccos(np.clip(cosine, -1.0, 1.0))
    sine = np.where(near, 1.0, np.sin(angle))
    one = np.where(near, 1.0 - t, np.sin((1.0 - t) * angle) / sine)
    two = np.where(near, t, np.sin(t * angle) / sine)
    mixed = one * first + two * last
    turned: Floats = mixed / np.linalg.norm(mixed, axis=1, keepdims=True)
    return turned
