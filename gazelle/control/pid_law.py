# cython: annotation_typing=False, infer_types=True
# mypy: disable-error-code="attr-defined, misc, no-any-return"
"""PID loops in native code, as control_toolbox has them."""

from __future__ import annotations

import cython
from cython.cimports.gazelle.native.rows import block_start, column, offset, start
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
        whole = self.memory[world, I_ERROR, loop] + dt * error
        whole = min(max(whole, self.sum_least[loop]), self.sum_most[loop])
        term = min(max(self.i[loop] * whole, self.term_least[loop]), self.term_most[loop])
        out = self.p[loop] * error + term + self.d[loop] * rate
        self.memory[world, P_ERROR, loop], self.memory[world, I_ERROR, loop] = error, whole
        self.memory[world, D_ERROR, loop], self.memory[world, OUTPUT, loop] = rate, out
        return out

    def push_row(
        self,
        world: int,
        errors: Floats,
        dt: float,
        near: bool,  # noqa: FBT001  native code
        rated: bool,  # noqa: FBT001
        rates: Floats,
        out: Floats,
    ) -> None:
        """Compute ``push`` of all loops of a world.

        Args:
            world: Index of the world.
            errors: Of each loop.
            dt: Since the last time [s].
            near: Whether all errors are known to be finite.
            rated: Whether rates of errors are given.
            rates: Those.
            out: Output.
        """
        count = self.count
        if dt <= 0.0 or not (near or are_finite(count, errors)):
            for k in range(count):
                out[k] = self.push(world, k, errors[k], dt, rated, rates[k] if rated else 0.0)
            return
        own = offset(self.memory_at, ROWS * count * world)
        known = offset(own, D_ERROR * count)
        if rated:
            for k in range(count):
                known[k] = rates[k]
        else:
            differentiate(count, dt, errors, offset(own, LAST * count), known)
        push_loops(
            count,
            dt,
            errors,
            known,
            offset(own, P_ERROR * count),
            offset(own, I_ERROR * count),
            offset(own, OUTPUT * count),
            out,
            self.p_at,
            self.i_at,
            self.d_at,
            self.sum_least_at,
            self.sum_most_at,
            self.term_least_at,
            self.term_most_at,
        )

    def compute(self, error: Floats, dt: float, rate: Floats | None, into: Floats) -> None:
        """Compute ``push`` of all loops in all worlds; all shapes are (nworld, loops)."""
        if not into.size:
            return
        rated = rate is not None
        errors, rates, out, period = error, error if rate is None else rate, into, dt
        with cython.nogil:
            for w in range(errors.shape[0]):
                first = w * self.count
                self.push_row(
                    w,
                    offset(start(errors), first),
                    period,
                    False,
                    rated,
                    offset(start(rates), first),
                    offset(start(out), first),
                )


def are_finite(count: int, values: Floats) -> bool:
    """Return whether all numbers are finite."""
    odd = 0
    for k in range(count):
        odd += 0 if isfinite(values[k]) else 1
    return odd == 0


def differentiate(count: int, dt: float, errors: Floats, last: Floats, rates: Floats) -> None:
    """Compute rates of errors since the last time."""
    for k in range(count):
        rates[k] = (errors[k] - last[k]) / dt
        last[k] = errors[k]


def push_loops(
    count: int, dt: float, errors: Floats, rates: Floats, p_error: Floats, i_error: Floats,
    output: Floats, out: Floats, p: Floats, i: Floats, d: Floats, sum_least: Floats,
    sum_most: Floats, term_least: Floats, term_most: Floats,
) -> None:  # fmt: skip
    """Update several loops at a time as ``PidLaw.push`` does, for finite errors."""
    for k in range(count):
        whole = i_error[k] + dt * errors[k]
        whole = min(max(whole, sum_least[k]), sum_most[k])
        term = min(max(i[k] * whole, term_least[k]), term_most[k])
        output[k] = p[k] * errors[k] + term + d[k] * rates[k]
        out[k] = output[k]
        p_error[k], i_error[k] = errors[k], whole
