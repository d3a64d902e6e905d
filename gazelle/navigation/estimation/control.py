"""Acceleration that a velocity command causes, as ``robot_localization`` predicts it."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from gazelle.argument_checks import checked
from gazelle.array_types import Bools, Floats
from gazelle.errors import Error
from gazelle.navigation.estimation.motion import TWIST

_SLACK = 0.01
"""A velocity this far beyond the command still counts as of its direction [m/s or rad/s]."""


def _six(value: float) -> Floats:
    return np.full(6, value)


@checked(Error)
@dataclass(frozen=True, slots=True)
class ControlModel:
    """Response of a robot to commands, for three linear and three angular velocities each.

    Attributes:
        used: Velocities that commands set.
        timeout: Age from which a command counts as zero [s].
        acceleration_limits: [m/s^2 or rad/s^2].
        deceleration_limits: [m/s^2 or rad/s^2].
        acceleration_gains: [1/s].
        deceleration_gains: [1/s].
    """

    used: Bools
    timeout: float
    acceleration_limits: Floats = field(default_factory=lambda: _six(1.0))
    deceleration_limits: Floats = field(default_factory=lambda: _six(1.0))
    acceleration_gains: Floats = field(default_factory=lambda: _six(1.0))
    deceleration_gains: Floats = field(default_factory=lambda: _six(1.0))

    def acceleration(self, state: Floats, command: Floats) -> Floats:
        """Return linear and angular accelerations, shape (6,), zero where commands are not used.

        Args:
            state: Of the filter, shape (15,).
            command: Velocities, shape (6,) [m/s and rad/s].
        """
        velocity = state[TWIST]
        error = command - velocity
        # A command against the motion first stops the robot.
        target = np.where(np.abs(error) <= np.abs(command) + _SLACK, command, 0.0)
        slower = np.abs(target) < np.abs(velocity)
        limits = np.where(slower, self.deceleration_limits, self.acceleration_limits)
        gains = np.where(slower, self.deceleration_gains, self.acceleration_gains)
        return np.where(self.used, np.clip(gains * error, -limits, limits), 0.0)


@dataclass(frozen=True, slots=True)
class StampedCommand:
    """Velocities that were commanded at a time.

    Attributes:
        velocities: Three linear [m/s] and three angular [rad/s], shape (6,).
        stamp: [ns].
    """

    velocities: Floats = field(default_factory=lambda: _six(0.0))
    stamp: int = 0
