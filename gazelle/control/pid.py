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

from gazelle.array_types import Floats, Worlds
from gazelle.control.parameters import ControllerParameters
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
    def read(cls, given: ControllerParameters) -> PidGains:
        """From ``p``, ``i``, ``d``, ``i_clamp``, ``i_clamp_min``, ``i_clamp_max`` and ``antiwindup``.

        Raises:
            ControlError: There is no ``p``, or one is of a wrong type.
        """
        clamp = abs(given.number("i_clamp", 0.0))
        return cls(
            p=given.number("p"),
            i=given.number("i", 0.0),
            d=given.number("d", 0.0),
            i_max=abs(given.number("i_clamp_max", clamp)),
            i_min=-abs(given.number("i_clamp_min", -clamp)),
            antiwindup=given.flag("antiwindup", default=False),
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
        output: What came out, likewise.
    """

    def __init__(self, gains: Sequence[PidGains], nworld: int = 1) -> None:
        shape = (nworld, len(gains))
        self.p_error: Floats = np.zeros(shape)
        self.i_error: Floats = np.zeros(shape)
        self.d_error: Floats = np.zeros(shape)
        self.output: Floats = np.zeros(shape)
        self._last: Floats = np.zeros(shape)
        self.set_gains(gains)

    @property
    def gains(self) -> tuple[PidGains, ...]:
        """Of each loop."""
        return self._gains

    def set_gains(self, gains: Sequence[PidGains]) -> None:
        """Go on with other gains.

        Raises:
            ControlError: A lower bound is above the upper one.
        """
        self._gains = tuple(gains)
        for each in gains:
            if not each.i_min <= each.i_max:
                raise ControlError(
                    f"the bounds of the integral are the wrong way round: {each.i_min}, {each.i_max}"
                )
        columns = np.array([(g.p, g.i, g.d, g.i_min, g.i_max) for g in gains]).reshape(-1, 5).T
        self._p, self._i, self._d, self._least, self._most = columns
        inner = np.array([g.antiwindup and g.i != 0.0 for g in gains], bool)
        outer = np.array([not g.antiwindup for g in gains], bool)
        divisor = np.where(inner, self._i, 1.0)
        with np.errstate(over="ignore"):  # a tiny gain has no bounds
            ends = np.sort(np.stack((self._least / divisor, self._most / divisor)), axis=0)
        self._sum_least = np.where(inner, ends[0], -math.inf)
        self._sum_most = np.where(inner, ends[1], math.inf)
        self._term_least = np.where(outer, self._least, -math.inf)
        self._term_most = np.where(outer, self._most, math.inf)

    def compute(self, error: Floats, dt: float, error_dot: Floats | None = None) -> Floats:
        """The outputs for errors now.

        Args:
            error: What is wanted less what is, shape (nworld, n).
            dt: Since the last time [s]; with 0 the output is 0, and nothing is remembered.
            error_dot: Rate of the error; that since the last time if None. After a reset the error
                before counts as 0, as in the original.

        Returns:
            Shape (nworld, n); 0 for an error that is not finite, which is not remembered either.
        """
        good = np.isfinite(error)
        whole = bool(good.all())
        if dt <= 0.0 or not (whole or good.any()):
            return np.zeros_like(self._last)
        if not whole:
            error = np.where(good, error, 0.0)
        rate = (error - self._last) / dt if error_dot is None else error_dot
        before = (self._last, self.p_error, self.i_error, self.d_error)
        sums = np.minimum(np.maximum(self.i_error + dt * error, self._sum_least), self._sum_most)
        term = np.minimum(np.maximum(self._i * sums, self._term_least), self._term_most)
        output: Floats = self._p * error + term + self._d * rate
        after = (error if error_dot is None else self._last, error, sums, rate)
        if not whole:
            after = tuple(np.where(good, new, old) for new, old in zip(after, before, strict=True))  # type: ignore[assignment]
            output = np.where(good, output, 0.0)
        self._last, self.p_error, self.i_error, self.d_error = after
        self.output = output
        return output

    @property
    def i_term(self) -> Floats:
        """The integral terms as they are now, shape (nworld, n)."""
        return np.clip(self._i * self.i_error, self._term_least, self._term_most)

    def reset(self, worlds: Worlds | None = None) -> None:
        """Forget errors and sums."""
        rows = slice(None) if worlds is None else worlds
        for name in ("p_error", "i_error", "d_error", "output", "_last"):
            kept = getattr(self, name).copy()
            kept[rows] = 0.0
            setattr(self, name, kept)

    def state(self) -> dict[str, NDArray[np.generic]]:
        """Everything that changes, gains apart."""
        return {"p": self.p_error.copy(), "i": self.i_error.copy(), "last": self._last.copy()}

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Put back what ``state`` gave."""
        self.p_error, self.i_error, self._last = (
            np.array(state[name], np.float64) for name in ("p", "i", "last")
        )


PID_TUNABLES = (
    TunableValue("p", 10.0, -100000.0, 100000.0, "Proportional gain."),
    TunableValue("i", 0.1, -100000.0, 100000.0, "Integral gain."),
    TunableValue("d", 1.0, -1000.0, 1000.0, "Derivative gain."),
    TunableValue("i_clamp_min", -10.0, -100000.0, 0.0, "Min bounds for the integral windup"),
    TunableValue("i_clamp_max", 10.0, 0.0, 100000.0, "Max bounds for the integral windup"),
    TunableValue("antiwindup", False, False, True, "Antiwindup."),
)
"""What control_toolbox/Parameters lets be changed."""


def pid_values(pid: Pid, loop: int = 0) -> dict[str, bool | float]:
    """The gains of a loop, by the names of ``PID_TUNABLES``."""
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
    """What changes the gains of a loop."""

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
