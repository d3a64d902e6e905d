"""Rewards and ends of openai_ros' ParrotDroneGoto, on arrays of what is observed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gazelle.array_types import Bools, Floats

GOAL = (9.0, 4.0, 2.0)
"""Goal position [m]; its height does not matter for the end."""
LOW, HIGH = (-1.0, -1.0, -1.0), (10.0, 5.0, 3.0)
"""Edges of the work space along x, y and z [m], as published."""
STEEPEST = 1.57
"""Largest roll and pitch [rad]."""
NEAREST, FARTHEST = 0.5, 5.0
"""Shortest distance measured by the sonar without an end, and its range [m]."""
CLOSER, END = 10.0, 200.0
"""Reward of a step that came nearer to the goal, and of an end."""
_AROUND, _AT = 1.0, 0.5


@dataclass(frozen=True, slots=True)
class FlightEnds:
    """Why episodes end, each of shape (n,).

    Attributes:
        outside: The drone left its work space.
        crashed: The sonar sees something too near, or the drone has flipped.
        arrived: It is within 1 m of the goal along x and along y.
        succeeded: It is within 0.5 m of it so, which is what the reward goes by.
    """

    outside: Bools
    crashed: Bools
    arrived: Bools
    succeeded: Bools

    @property
    def over(self) -> Bools:
        """True where the episode ends."""
        return self.outside | self.crashed | self.arrived


def ends_of(seen: Floats) -> FlightEnds:
    """Why episodes end.

    Args:
        seen: Observations, shape (n, 7): x, y, z, roll, pitch, yaw, sonar.
    """
    place, tilt, sonar = seen[:, :3], seen[:, 3:5], seen[:, 6]
    inside = np.all((place > LOW) & (place <= HIGH), axis=1)
    flipped = ~np.all((tilt > -STEEPEST) & (tilt <= STEEPEST), axis=1)
    return FlightEnds(
        ~inside, flipped | (sonar < NEAREST), _within(place, _AROUND), _within(place, _AT)
    )


def reward_of(ends: FlightEnds, closer: Bools) -> Floats:
    """Return the reward of a step, shape (n,).

    Args:
        ends: Why episodes end.
        closer: Whether the drone came nearer to the goal, as observed.
    """
    last = np.where(ends.succeeded, END, -END)
    reward: Floats = np.where(ends.over, last, CLOSER * closer)
    return reward


def distance_of(place: Floats) -> Floats:
    """Return the distances of positions, shape (n, 3), from the goal [m], shape (n,)."""
    return np.asarray(np.linalg.norm(place - GOAL, axis=1), np.float64)


def _within(place: Floats, tolerance: float) -> Bools:
    goal = np.array(GOAL[:2])
    level = place[:, :2]
    inside: Bools = np.all((level > goal - tolerance) & (level <= goal + tolerance), axis=1)
    return inside
