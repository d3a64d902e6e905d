# cython: annotation_typing=False, infer_types=True
# mypy: disable-error-code="attr-defined, misc, no-any-return"
"""PID loops in native code, as control_toolbox has them."""

from __future__ import annotations

from collections.abc import Sequence

import cython
from cython.cimports.libc.math import isfinite

from gazelle.array_types import Floats


@cython.cclass
class PidLaw:
    """What ``Pid`` remembers, and how it goes on.

    Args:
        memory: The last error as ``push`` takes rates from, the last error, its integral, its rate,
            and the output, each of shape (nworld, loops); used in place.
    """

    def __init__(self, memory: Sequence[Floats]) -> None:
        self.last, self.p_error, self.i_error, self.d_error, self.output = memory

    def tune(self, columns: Sequence[Floats]) -> None:
        """Go on with other gains, shape (loops,) each.

        Args:
            columns: p, i, d, and least and greatest values of the integral and of its term.
        """
        self.p, self.i, self.d = columns[:3]
        self.sum_least, self.sum_most, self.term_least, self.term_most = columns[3:]

    def push(
        self,
        world: int,
        loop: int,
        error: float,
        dt: float,
        rated: bool,  # noqa: FBT001  native code
        given: float,
    ) -> float:
        """The output for an error now; 0 in no time, or for one that is not finite.

        Args:
            world: Which.
            loop: Which.
            error: What is wanted less what is.
            dt: Since the last time [s].
            rated: Whether the rate of the error is given, not that since the last time.
            given: That.
        """
        if dt <= 0.0 or not isfinite(error):
            return 0.0
        if rated:
            rate = given
        else:
            rate = (error - self.last[world, loop]) / dt
            self.last[world, loop] = error
        whole = self.i_error[world, loop] + dt * error
        whole = min(max(whole, self.sum_least[loop]), self.sum_most[loop])
        term = min(max(self.i[loop] * whole, self.term_least[loop]), self.term_most[loop])
        out = self.p[loop] * error + term + self.d[loop] * rate
        self.p_error[world, loop], self.i_error[world, loop] = error, whole
        self.d_error[world, loop], self.output[world, loop] = rate, out
        return out

    def compute(self, error: Floats, dt: float, rate: Floats | None, into: Floats) -> None:
        """``push`` of all loops in all worlds; all shapes are (nworld, loops)."""
        rated = rate is not None
        errors, rates, out, period = error, error if rate is None else rate, into, dt
        with cython.nogil:
            for w in range(errors.shape[0]):
                for k in range(errors.shape[1]):
                    out[w, k] = self.push(w, k, errors[w, k], period, rated, rates[w, k])
