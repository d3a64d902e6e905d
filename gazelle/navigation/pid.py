"""A PID controller with a limited integral, for many loops at once."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gazelle.argument_checks import checked
from gazelle.array_types import Floats
from gazelle.engines.limits import MAX_WORLDS, integer
from gazelle.errors import ControlError

Rows = NDArray[np.intp] | slice


@checked(ControlError)
class BoundedPid:
    """Proportional, integral and derivative action on an error.

    The integral term (gain included) and the output are kept within bounds: the integral
    cannot wind up beyond what it may add.

    Args:
        p: Gain on the error.
        i: Gain on its integral [1/s].
        d: Gain on its change [s].
        integral: Least and greatest value of the integral term.
        output: Least and greatest output.
        count: Number of loops.

    Raises:
        ControlError: A bound is not one.
    """

    def __init__(
        self,
        p: float,
        i: float = 0.0,
        d: float = 0.0,
        *,
        integral: tuple[float, float] = (-math.inf, math.inf),
        output: tuple[float, float] = (-math.inf, math.inf),
        count: int = 1,
    ) -> None:
        for name, (low, high) in (("integral", integral), ("output", output)):
            if not low <= high:
                raise ControlError(f"the bounds of the {name} are reversed: {low}, {high}")
        integer("the number of loops", count, least=0, most=MAX_WORLDS)
        self.p, self.i, self.d = p, i, d
        self.integral, self.output = integral, output
        self._sum = np.zeros(count)
        self._last = np.full(count, math.nan)

    def update(self, error: ArrayLike, dt: float, rows: Rows | None = None) -> Floats:
        """Return the outputs for the errors now.

        Args:
            error: Shape (n,), or one number for all.
            dt: Time since the last update [s]; with 0 nothing is integrated or derived.
            rows: Loops; all if None.

        Returns:
            Shape (n,).

        Raises:
            ControlError: ``dt`` is negative or not finite.
        """
        if not 0.0 <= dt < math.inf:
            raise ControlError(f"dt must be positive, not {dt} s")
        which = slice(None) if rows is None else rows
        last = self._last[which]
        now = np.broadcast_to(np.asarray(error, np.float64), last.shape)
        rate = np.zeros_like(last)
        if dt > 0.0:
            self._sum[which] = np.clip(self._sum[which] + self.i * now * dt, *self.integral)
            rate = np.where(np.isnan(last), 0.0, (now - last) / dt)
        self._last[which] = now
        effort = self.p * now + self._sum[which] + self.d * rate
        out: Floats = np.clip(effort, *self.output)
        return out

    def reset(self, rows: Rows | None = None) -> None:
        """Reset these loops, all if None."""
        which = slice(None) if rows is None else rows
        self._sum[which], self._last[which] = 0.0, math.nan
