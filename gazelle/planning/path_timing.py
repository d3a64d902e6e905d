"""Time-optimal timing of a path: the fastest profile of speeds along it, compiled.

Method: Pham and Pham, "A new approach to time-optimal path parameterization based on reachability
analysis", IEEE Transactions on Robotics 34, 2018: backwards the speeds from which the end can be
reached, then forwards the highest of them. With x the square of the speed along the path and u the
acceleration along it, joints have the velocity q' sqrt(x) and the acceleration q' u + q'' x.
"""

# mypy: disallow-untyped-decorators=False

import cython
import numpy as np
from cython.cimports.libc.math import fabs

from gazelle.array_types import Floats

_HALVINGS = cython.declare(cython.int, 60)
_TINY = cython.declare(cython.double, 1e-12)
_LARGE = cython.declare(cython.double, 1e12)


@cython.cclass
class SpeedProfile:
    """The fastest way along a path, at rest at both ends.

    Args:
        places: Along the path, rising, shape (m,).
        slopes: Derivatives of positions by the place, shape (m, n).
        bends: Second derivatives, shape (m, n).
        velocity: Limits [m/s or rad/s], shape (n,).
        acceleration: Limits [m/s² or rad/s²], shape (n,).
    """

    _places: cython.double[::1]
    _slopes: cython.double[:, ::1]
    _bends: cython.double[:, ::1]
    _velocity: cython.double[::1]
    _acceleration: cython.double[::1]
    _squares: cython.double[::1]
    _least: cython.double
    _most: cython.double

    def __init__(
        self, places: Floats, slopes: Floats, bends: Floats, velocity: Floats, acceleration: Floats
    ) -> None:
        self._places = np.ascontiguousarray(places, np.float64)
        self._slopes = np.ascontiguousarray(slopes, np.float64)
        self._bends = np.ascontiguousarray(bends, np.float64)
        self._velocity = np.ascontiguousarray(velocity, np.float64)
        self._acceleration = np.ascontiguousarray(acceleration, np.float64)
        self._squares = np.zeros(len(places))
        self._least = self._most = 0.0

    def squares(self, ceilings: Floats) -> Floats:
        """Return squares of the speed at the places, shape (m,).

        Args:
            ceilings: Upper bounds, shape (m,).
        """
        bounds: cython.double[::1] = np.ascontiguousarray(ceilings, np.float64)
        i: cython.int
        last: cython.int = self._places.shape[0] - 1
        self._squares[last] = 0.0
        for i in range(last - 1, -1, -1):
            self._squares[i] = self._highest(i, self._places[i + 1] - self._places[i], bounds[i])
        self._squares[0] = 0.0
        for i in range(last):
            step: cython.double = self._places[i + 1] - self._places[i]
            self._bound(i, self._squares[i])
            reached: cython.double = self._squares[i] + 2.0 * step * self._most
            self._squares[i + 1] = max(0.0, min(self._squares[i + 1], reached))
        return np.array(self._squares)

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def _highest(self, i: cython.int, step: cython.double, ceiling: cython.double) -> cython.double:
        """Return the highest square of the speed here that still allows the next place's."""
        k: cython.int
        high: cython.double = min(_LARGE, ceiling)
        for k in range(self._velocity.shape[0]):
            slope: cython.double = fabs(self._slopes[i, k])
            if slope > _TINY:
                high = min(high, (self._velocity[k] / slope) * (self._velocity[k] / slope))
        if self._holds(i, high, step):
            return high
        low: cython.double = 0.0
        for _ in range(_HALVINGS):
            middle: cython.double = 0.5 * (low + high)
            if self._holds(i, middle, step):
                low = middle
            else:
                high = middle
        return low

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def _holds(self, i: cython.int, x: cython.double, step: cython.double) -> cython.bint:
        """Return whether a speed is feasible here and can lead to one that the next place allows."""
        self._bound(i, x)
        if self._least > self._most:
            return False
        return x + 2.0 * step * self._least <= self._squares[i + 1] and (
            x + 2.0 * step * self._most >= 0.0
        )

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def _bound(self, i: cython.int, x: cython.double) -> cython.void:
        """Compute least and most acceleration along the path that all joints allow at a speed."""
        k: cython.int
        self._least, self._most = -_LARGE, _LARGE
        for k in range(self._velocity.shape[0]):
            slope: cython.double = self._slopes[i, k]
            limit: cython.double = self._acceleration[k]
            bend: cython.double = self._bends[i, k] * x
            if fabs(slope) <= _TINY:
                if fabs(bend) > limit:
                    self._least, self._most = 1.0, -1.0
                    return
                continue
            one: cython.double = (limit - bend) / slope
            other: cython.double = (-limit - bend) / slope
            self._least = max(self._least, min(one, other))
            self._most = min(self._most, max(one, other))
