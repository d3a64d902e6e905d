# cython: annotation_typing=False, infer_types=True
# mypy: disable-error-code="attr-defined, misc, no-any-return"
"""Limits of joints applied to commands, in native code (``limits``)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import cython
import numpy as np
from cython.cimports.gazelle.native.rows import column
from cython.cimports.libc.math import INFINITY, isfinite

from gazelle.array_types import Floats


def clamp(value: float, low: float, high: float) -> float:
    """Return a value within an interval; of an empty one the upper end."""
    return min(max(value, low), high)


@cython.cclass
class LimitLaw:
    """Limits of some joints.

    Args:
        columns: By name, shape (n,) each: ``lower``, ``upper``, ``velocity``, ``acceleration``,
            ``effort``, ``soft`` (whether there are soft limits), ``bounded`` (whether they bound
            positions), ``k_position``, ``k_velocity``, ``soft_lower``, ``soft_upper``.

    Attributes:
        hard: Whether no joint has soft limits.
    """

    def __init__(self, columns: Mapping[str, Any]) -> None:
        # Side by side: so they take few lines of a processor's cache.
        table = np.array([*columns.values()], np.float64)
        numbers = dict(zip(columns, table, strict=True))
        self.lower, self.upper = numbers["lower"], numbers["upper"]
        self.velocity, self.effort = numbers["velocity"], numbers["effort"]
        self.acceleration = numbers["acceleration"]
        self.k_position, self.k_velocity = numbers["k_position"], numbers["k_velocity"]
        self.soft_lower, self.soft_upper = numbers["soft_lower"], numbers["soft_upper"]
        self.soft = np.array(columns["soft"], np.uint8)
        self.bounded = np.array(columns["bounded"], np.uint8)
        self.hard, self.count = not np.any(columns["soft"]), len(columns["soft"])
        self.lower_at, self.upper_at = column(self.lower), column(self.upper)
        self.velocity_at, self.effort_at = column(self.velocity), column(self.effort)

    def soft_bound(self, i: int, position: float, high: bool) -> float:  # noqa: FBT001  native code
        """Return the least or the greatest velocity within soft limits at a position."""
        if not self.bounded[i]:
            return self.velocity[i] if high else -self.velocity[i]
        end = self.soft_upper[i] if high else self.soft_lower[i]
        desired = -self.k_position[i] * (position - end)
        return clamp(desired, -self.velocity[i], self.velocity[i])

    def hold_effort(self, i: int, command: float, position: float, velocity: float) -> float:
        """Return the limited effort; beyond a limit only effort that leads back."""
        if self.soft[i]:
            least = -self.k_velocity[i] * (velocity - self.soft_bound(i, position, False))
            most = -self.k_velocity[i] * (velocity - self.soft_bound(i, position, True))
            low = clamp(least, -self.effort[i], self.effort[i])
            high = clamp(most, -self.effort[i], self.effort[i])
        else:
            low, high = -self.effort[i], self.effort[i]
            if position < self.lower[i] or velocity < -self.velocity[i]:
                low = 0.0
            if position > self.upper[i] or velocity > self.velocity[i]:
                high = 0.0
        return clamp(command, low, high)

    def hold_position(self, i: int, command: float, before: float, dt: float) -> float:
        """Return the limited position command, given the one before."""
        low, high = self.soft_bound(i, before, False), self.soft_bound(i, before, True)
        low = before + low * dt if isfinite(low) else -INFINITY
        high = before + high * dt if isfinite(high) else INFINITY
        low, high = max(low, self.lower[i]), min(high, self.upper[i])
        return clamp(command, low, high)

    def hold_velocity(
        self, i: int, command: float, position: float, velocity: float, before: float, dt: float
    ) -> float:
        """Return the limited velocity command; hard limits start from the last command."""
        low, high = self.soft_bound(i, position, False), self.soft_bound(i, position, True)
        if isfinite(self.acceleration[i]):
            start = velocity if self.soft[i] else before
            change = self.acceleration[i] * dt
            low, high = max(low, start - change), min(high, start + change)
        return clamp(command, low, high)

    def hold_efforts(self, command: Floats, position: Floats, velocity: Floats) -> Floats:
        """Return ``hold_effort`` of all, shape (nworld, n)."""
        held = np.empty(command.shape)
        a, b, c, out = command, position, velocity, held
        with cython.nogil:
            for w in range(a.shape[0]):
                for i in range(a.shape[1]):
                    out[w, i] = self.hold_effort(i, a[w, i], b[w, i], c[w, i])
        return held

    def hold_positions(
        self, command: Floats, position: Floats, previous: Floats, dt: float
    ) -> Floats:
        """Return ``hold_position`` of all, from ``previous``, or without one from ``position``."""
        held = np.empty(command.shape)
        before = np.where(np.isnan(previous), position, previous)
        a, b, out, period = command, before, held, dt
        with cython.nogil:
            for w in range(a.shape[0]):
                for i in range(a.shape[1]):
                    out[w, i] = self.hold_position(i, a[w, i], b[w, i], period)
        return held

    def hold_velocities(
        self, command: Floats, position: Floats, velocity: Floats, previous: Floats, dt: float
    ) -> Floats:
        """Return ``hold_velocity`` of all."""
        held = previous.copy("C")
        a, b, c, out, period = command, position, velocity, held, dt
        with cython.nogil:
            for w in range(a.shape[0]):
                for i in range(a.shape[1]):
                    out[w, i] = self.hold_velocity(i, a[w, i], b[w, i], c[w, i], out[w, i], period)
        return held
