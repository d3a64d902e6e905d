# cython: annotation_typing=False, infer_types=True
# mypy: disable-error-code="attr-defined, misc, no-any-return"
"""PID loops in native code, as control_toolbox has them."""

from __future__ import annotations

import cython
from cython.cimports.gazelle.control.joint_math import clamp, pid_output
from cython.cimports.gazelle.native.rows import block_start, column
from cython.cimports.libc.math import isfinite

from gazelle.array_types import Floats

# What is remembered of a world, row by row.
if not cython.compiled:  # else what pid_law.pxd says
    LAST, P_ERROR, I_ERROR, D_ERROR, OUTPUT, ROWS = 0, 1, 2, 3, 4, 5


@cython.cclass
class PidLaw:
    """State of ``Pid``, and its update.

    Args:
        memory: The last error as ``push`` takes rates from, the last error, its integral, its rate,
            and the output, shape (nworld, 5, loops); used in place.
    """

    def __init__(self, memory: Floats) -> None:
        self.memory, self.count = memory, memory.shape[2]
        self.memory_at = block_start(self.memory)

    def tune(self, columns: Floats) -> None:
        """Set the gains.

        Args:
            columns: p, i, d, and least and greatest values of the integral and of its term, shape
                (7, loops).
        """
        self.p, self.i, self.d = columns[:3]
        self.sum_least, self.sum_most, self.term_least, self.term_most = columns[3:]
        self.p_at, self.i_at, self.d_at = column(self.p), column(self.i), column(self.d)
        self.sum_least_at, self.sum_most_at = column(self.sum_least), column(self.sum_most)
        self.term_least_at, self.term_most_at = column(self.term_least), column(self.term_most)

    def push(
        self,
        world: int,
        loop: int,
        error: float,
        dt: float,
        rated: bool,  # noqa: FBT001  native code
        given: float,
    ) -> float:
        """Return the output for an error now; 0 in no time, or for one that is not finite.

        Args:
            world: Index of the world.
            loop: Index of the loop.
            error: Desired less actual value.
            dt: Since the last time [s].
            rated: Whether the rate of the error is given, not that since the last time.
            given: Derivative of the error.
        """
        if dt <= 0.0 or not isfinite(error):
            return 0.0
        if rated:
            rate = given
        else:
            rate = (error - self.memory[world, LAST, loop]) / dt
            self.memory[world, LAST, loop] = error
        whole = clamp(
            self.memory[world, I_ERROR, loop] + dt * error,
            self.sum_least[loop],
            self.sum_most[loop],
        )
        out = pid_output(
            error, whole, rate, self.p[loop], self.i[loop], self.d[loop],
            self.term_least[loop], self.term_most[loop],
        )  # fmt: skip
        self.memory[world, P_ERROR, loop], self.memory[world, I_ERROR, loop] = error, whole
        self.memory[world, D_ERROR, loop], self.memory[world, OUTPUT, loop] = rate, out
        return out

    def compute(self, error: Floats, dt: float, rate: Floats | None, into: Floats) -> None:
        """Compute ``push`` of all loops in all worlds; all shapes are (nworld, loops)."""
        rated = rate is not None
        errors, rates, out, period = error, error if rate is None else rate, into, dt
        with cython.nogil:
            for w in range(errors.shape[0]):
                for k in range(errors.shape[1]):
                    out[w, k] = self.push(w, k, errors[w, k], period, rated, rates[w, k])
