"""PID control, as ros_control's control_toolbox has it.

The output is ``p e + i_term + d de/dt``, not clamped unless bounds are given. The integral term is
held within ``i_min`` and ``i_max``: the term alone, or with ``antiwindup`` the integral itself. Those are 0
where nothing is said, so that there is no integral term then.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, Indices, Worlds
from gazelle.control.parameters import ControllerParameters
from gazelle.control.pid_law import PidLaw
from gazelle.control.ports import TunableValue
from gazelle.errors import ControlError


@dataclass(frozen=True, slots=True)
class PidGains:
    """Gains of one loop.

    Attributes:
        p: On the error.
        i: On its integral [1/s].
        d: On its rate [s].
        i_max: Upper bound of the integral term.
        i_min: Lower bound.
        antiwindup: Whether the integral itself is bounded, instead of its term.
    """

    p: float = 0.0
    i: float = 0.0
    d: float = 0.0
    i_max: float = 0.0
    i_min: float = 0.0
    antiwindup: bool = False

    @classmethod
    def read(cls, parameters: ControllerParameters) -> PidGains:
        """Read ``p``, ``i``, ``d``, the clamps and ``antiwindup``.

        The clamps are ``i_clamp``, ``i_clamp_min`` and ``i_clamp_max``.

        Raises:
            ControlError: There is no ``p``, or one is of a wrong type.
        """
        clamp = abs(parameters.number("i_clamp", 0.0))
        return cls(
            p=parameters.number("p"),
            i=parameters.number("i", 0.0),
            d=parameters.number("d", 0.0),
            i_max=abs(parameters.number("i_clamp_max", clamp)),
            i_min=-abs(parameters.number("i_clamp_min", -clamp)),
            antiwindup=parameters.flag("antiwindup", default=False),
        )


class Pid:
    """PID loops in many worlds.

    Args:
        gains: One for each loop of a world, shape (n,).
        nworld: Number of worlds.

    Attributes:
        p_error: The last error, shape (nworld, n).
        i_error: Its integral, likewise.
        d_error: Its rate, likewise.
        output: Output, likewise.
        law: The same in native code, on the same arrays.
    """

    def __init__(self, gains: Sequence[PidGains], nworld: int = 1) -> None:
        # All of a world side by side: so it takes few lines of a processor's cache.
        memory = np.zeros((nworld, 5, len(gains)))
        self._last, self.p_error, self.i_error, self.d_error, self.output = memory.swapaxes(0, 1)
        self.law = PidLaw(memory)
        self.set_gains(gains)

    @property
    def gains(self) -> tuple[PidGains, ...]:
        """Gains of each loop."""
        return self._gains

    def set_gains(self, gains: Sequence[PidGains]) -> None:
        """Set the gains.

        Raises:
            ControlError: A lower bound is above the upper one.
        """
        self._gains = tuple(gains)
        for each in gains:
            if not each.i_min <= each.i_max:
                raise ControlError(
                    f"the lower bound of the integral is above the upper: {each.i_min}, {each.i_max}"
                )
        rows = np.array([(g.p, g.i, g.d, g.i_min, g.i_max) for g in gains], np.float64)
        p, i, d, least, most = np.ascontiguousarray(rows.reshape(-1, 5).T)
        inner = np.array([g.antiwindup and g.i != 0.0 for g in gains], bool)
        outer = np.array([not g.antiwindup for g in gains], bool)
        divisor = np.where(inner, i, 1.0)
        with np.errstate(over="ignore"):  # a tiny gain has no bounds
            ends = np.sort(np.stack((least / divisor, most / divisor)), axis=0)
        sum_least, sum_most = (
            np.where(inner, ends[0], -math.inf),
            np.where(inner, ends[1], math.inf),
        )
        term_least, term_most = np.where(outer, least, -math.inf), np.where(outer, most, math.inf)
        self.law.tune(np.array((p, i, d, sum_least, sum_most, term_least, term_most)))
        self._term = (i, term_least, term_most)

    def compute(self, error: Floats, dt: float, error_dot: Floats | None = None) -> Floats:
        """Return the outputs for errors now.

        Args:
            error: Desired less actual value, shape (nworld, n).
            dt: Since the last time [s]; with 0 the output is 0, and nothing is remembered.
            error_dot: Rate of the error; that since the last time if None. After a reset the error
                before counts as 0, as in the original.

        Returns:
            Shape (nworld, n); 0 for an error that is not finite, which is not remembered either.
        """
        output = np.empty(self.output.shape)
        rate = None if error_dot is None else self._whole(error_dot)
        self.law.compute(self._whole(error), dt, rate, output)
        return output

    def _whole(self, values: Floats) -> Floats:
        """Return values for every loop of every world."""
        return np.array(np.broadcast_to(values, self.output.shape), np.float64, order="C")

    @property
    def i_term(self) -> Floats:
        """The integral terms as they are now, shape (nworld, n)."""
        gain, least, most = self._term
        terms: Floats = np.clip(gain * self.i_error, least, most)
        return terms

    def reset(self, worlds: Worlds | None = None) -> None:
        """Discard errors and integrals."""
        rows = slice(None) if worlds is None else worlds
        for kept in (self.p_error, self.i_error, self.d_error, self.output, self._last):
            kept[rows] = 0.0

    def forget_rates(self, loops: Indices, worlds: Worlds) -> None:
        """Set the previous error of some loops to 0 in some worlds; their integrals stay."""
        self._last[np.ix_(worlds, loops)] = 0.0

    def state(self) -> dict[str, NDArray[np.generic]]:
        """Return all mutable state except gains."""
        return {"p": self.p_error.copy(), "i": self.i_error.copy(), "last": self._last.copy()}

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        self.p_error[:], self.i_error[:] = state["p"], state["i"]
        self._last[:] = state["last"]


PID_TUNABLES = (
    TunableValue("p", 10.0, -100000.0, 100000.0, "Proportional gain."),
    TunableValue("i", 0.1, -100000.0, 100000.0, "Integral gain."),
    TunableValue("d", 1.0, -1000.0, 1000.0, "Derivative gain."),
    TunableValue("i_clamp_min", -10.0, -100000.0, 0.0, "Min bounds for the integral windup"),
    TunableValue("i_clamp_max", 10.0, 0.0, 100000.0, "Max bounds for the integral windup"),
    TunableValue("antiwindup", False, False, True, "Antiwindup."),
)
"""Parameters that control_toolbox/Parameters makes changeable."""


def pid_values(pid: Pid, loop: int = 0) -> dict[str, bool | float]:
    """Return the gains of a loop, by the names of ``PID_TUNABLES``."""
    gains = pid.gains[loop]
    return {
        "p": gains.p,
        "i": gains.i,
        "d": gains.d,
        "i_clamp_min": gains.i_min,
        "i_clamp_max": gains.i_max,
        "antiwindup": gains.antiwindup,
    }


def pid_changer(pid: Pid, loop: int = 0) -> Callable[[Mapping[str, Any]], None]:
    """Return a function that changes the gains of a loop."""

    def change(values: Mapping[str, Any]) -> None:
        gains = list(pid.gains)
        gains[loop] = replace(
            gains[loop],
            p=values["p"],
            i=values["i"],
            d=values["d"],
            i_min=values["i_clamp_min"],
            i_max=values["i_clamp_max"],
            antiwindup=values["antiwindup"],
        )
        pid.set_gains(gains)

    return change
