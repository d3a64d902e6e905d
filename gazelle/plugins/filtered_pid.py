"""PID controllers on filtered commands, as Hector's and SJTU's quadrotors have them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Bools, Floats, Worlds
from gazelle.description import Parameters


@dataclass(frozen=True, slots=True)
class FilteredGains:
    """Gains of one kind of controller, with the original's defaults.

    Attributes:
        proportional: Of the error.
        differential: Of the error's rate.
        integral: Of the error's sum over time.
        time_constant: Of the filter of commands [s]; 0 for none.
        limit: Largest command either way; none unless it is above 0.
    """

    proportional: float = 5.0
    differential: float = 1.0
    integral: float = 0.0
    time_constant: float = 0.0
    limit: float = -1.0

    @classmethod
    def read(cls, parameters: Parameters, prefix: str) -> FilteredGains:
        """Read the tags that begin with a prefix, such as ``yawProportionalGain``."""
        own = cls()
        return cls(
            parameters.get(f"{prefix}ProportionalGain", own.proportional),
            parameters.get(f"{prefix}DifferentialGain", own.differential),
            parameters.get(f"{prefix}IntegralGain", own.integral),
            parameters.get(f"{prefix}TimeConstant", own.time_constant),
            parameters.get(f"{prefix}Limit", own.limit),
        )


class FilteredPids:
    """Some controllers with equal gains, in every world.

    Args:
        gains: Of all.
        nworld: Number of worlds.
        count: Number of controllers.
    """

    def __init__(self, gains: FilteredGains, nworld: int, count: int) -> None:
        self._gains = gains
        self._command, self._sum = np.zeros((2, nworld, count))

    def update(
        self, command: Floats, value: Floats, rate: Floats | float, step: float, acting: Bools
    ) -> Floats:
        """Return the output of the controllers, shape (nworld, count).

        Args:
            command: Desired value, shape (nworld, count).
            value: Actual value, likewise.
            rate: Derivative, likewise or one for all.
            step: Time since the last update [s].
            acting: Worlds that are updated, shape (nworld,); in others the controllers rest, and
                the output is undefined.
        """
        gains = self._gains
        if gains.limit > 0.0:
            command = np.clip(command, -gains.limit, gains.limit)
        wanted_rate: Floats | float = 0.0
        if gains.time_constant > 0.0:
            whole = step + gains.time_constant
            filtered = (step * command + gains.time_constant * self._command) / whole
            wanted_rate = (command - filtered) / whole
            self._command[acting] = filtered[acting]
            command = filtered
        error = command - value
        output: Floats = gains.proportional * error + gains.differential * (wanted_rate - rate)
        if gains.integral != 0.0:
            self._sum[acting] += step * error[acting]
            output = output + gains.integral * self._sum
        return output

    def reset(self, worlds: Worlds | None) -> None:
        """Discard filtered commands and sums."""
        rows = slice(None) if worlds is None else worlds
        self._command[rows] = self._sum[rows] = 0.0

    def state(self) -> dict[str, NDArray[np.generic]]:
        """Return filtered commands and integrals."""
        return {"command": self._command.copy(), "sum": self._sum.copy()}

    def restore(self, state: dict[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        self._command[:], self._sum[:] = state["command"], state["sum"]
