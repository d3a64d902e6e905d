"""PID controllers as Gazebo has them, in every world.

The output is ``-(p e + i sum + d de/dt)`` of the error ``e = measured - wanted``, each sum and
the output held within limits; limits with the upper end below the lower do not hold.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, Worlds
from gazelle.description import Parameters
from gazelle.errors import SimulationError


@dataclass(frozen=True, slots=True)
class Gains:
    """Gains and limits of a PID controller.

    Attributes:
        p: Proportional.
        i: Integral.
        d: Derivative.
        i_max: Largest integral term.
        i_min: Smallest integral term.
        most: Largest output.
        least: Smallest output.
    """

    p: float = 0.0
    i: float = 0.0
    d: float = 0.0
    i_max: float = math.inf
    i_min: float = -math.inf
    most: float = math.inf
    least: float = -math.inf

    @classmethod
    def read(cls, parameters: Parameters | None) -> Gains:
        """Read the tags ``p``, ``i``, ``d``, ``i_max``, ``i_min``, ``cmd_max``, ``cmd_min``.

        0 each.
        """
        if parameters is None:
            return cls(most=0.0, least=0.0)
        tags = ("p", "i", "d", "i_max", "i_min", "cmd_max", "cmd_min")
        return cls(*(parameters.get(tag, 0.0) for tag in tags))

    @classmethod
    def of_ros_control(cls, parameters: Mapping[str, Any], most: float) -> Gains:
        """Read the parameters of ros_control's PID: without ``i_clamp`` there are no integrals.

        Args:
            parameters: ``p``, ``i``, ``d``, ``i_clamp``, ``i_clamp_max`` and ``i_clamp_min``.
            most: Largest output either way.

        Raises:
            SimulationError: One is not a number.
        """
        try:
            p, i, d, clamp = (
                float(parameters.get(name, 0.0)) for name in ("p", "i", "d", "i_clamp")
            )
            highest = float(parameters.get("i_clamp_max", abs(clamp)))
            lowest = float(parameters.get("i_clamp_min", -abs(clamp)))
        except (TypeError, ValueError, OverflowError):
            raise SimulationError(f"gains must be numbers, not {dict(parameters)}") from None
        return cls(p, i, d, i_max=highest, i_min=lowest, most=most, least=-most)


class GazeboPid:
    """One controller in every world.

    Args:
        gains: Of all worlds.
        nworld: Number of worlds.
    """

    def __init__(self, gains: Gains, nworld: int) -> None:
        self.gains = gains
        self._sum: Floats = np.zeros(nworld)
        self._last: Floats = np.zeros(nworld)

    def update(self, error: Floats, interval: float) -> Floats:
        """Return the output, from measured less target, both of shape (nworld,)."""
        gains = self.gains
        if interval <= 0.0:
            return np.zeros_like(error)
        self._sum = self._sum + interval * error
        integral = gains.i * self._sum
        if gains.i_max >= gains.i_min and gains.i != 0.0:
            integral = np.clip(integral, gains.i_min, gains.i_max)
            self._sum = integral / gains.i
        change = (error - self._last) / interval
        self._last = error
        output = -gains.p * error - integral - gains.d * change
        if gains.most >= gains.least:
            output = np.clip(output, gains.least, gains.most)
        return output

    def reset(self, worlds: Worlds | None = None) -> None:
        """Discard sums and errors."""
        rows = slice(None) if worlds is None else worlds
        self._sum[rows], self._last[rows] = 0.0, 0.0

    def state(self) -> dict[str, NDArray[np.generic]]:
        """Return all mutable state."""
        return {"sum": self._sum.copy(), "last": self._last.copy()}

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        self._sum[:], self._last[:] = state["sum"], state["last"]
