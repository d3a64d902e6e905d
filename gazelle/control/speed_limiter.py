"""Limits of the velocity, acceleration and jerk of a base."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from gazelle.array_types import Floats
from gazelle.control.base_law import limit_speeds
from gazelle.control.parameters import ControllerParameters
from gazelle.errors import ControlError


@dataclass(frozen=True, slots=True)
class SpeedLimiter:
    """Bounds of one velocity: least and greatest; infinite where there are none.

    Attributes:
        velocity: [m/s or rad/s].
        acceleration: [m/s² or rad/s²].
        jerk: [m/s³ or rad/s³].
    """

    velocity: tuple[float, float] = (-math.inf, math.inf)
    acceleration: tuple[float, float] = (-math.inf, math.inf)
    jerk: tuple[float, float] = (-math.inf, math.inf)

    @classmethod
    def read(cls, parameters: ControllerParameters) -> SpeedLimiter:
        """Read ``has_X_limits``, ``max_X`` and ``min_X``, which is ``-max_X`` if missing.

        Raises:
            ControlError: There are limits without a ``max_X``, or the wrong way round.
        """
        return cls(
            _bounds(parameters, "velocity"),
            _bounds(parameters, "acceleration"),
            _bounds(parameters, "jerk"),
        )

    def limit(self, velocity: Floats, before: Floats, earlier: Floats, dt: float) -> Floats:
        """Return the limited velocity, shape (n,): jerk first, then acceleration, then velocity.

        Args:
            velocity: Velocity now, shape (n,).
            before: The last one, likewise.
            earlier: The one before that, likewise.
            dt: Since the last one [s].
        """
        return limit_speeds((velocity, before, earlier), dt, np.array(self.bounds))

    @property
    def bounds(self) -> tuple[float, ...]:
        """All six, as native code takes them."""
        return (*self.velocity, *self.acceleration, *self.jerk)


def _bounds(parameters: ControllerParameters, what: str) -> tuple[float, float]:
    if not parameters.flag(f"has_{what}_limits", default=False):
        return (-math.inf, math.inf)
    most = parameters.number(f"max_{what}")
    least = parameters.number(f"min_{what}", -most)
    if least > most:
        raise ControlError(
            f"'{parameters.place}/min_{what}' ({least:g}) is above 'max_{what}' ({most:g})"
        )
    return least, most
