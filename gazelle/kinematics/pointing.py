"""Turning joints until something, such as a camera, points at a place."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from gazelle.argument_checks import checked
from gazelle.array_types import Floats
from gazelle.errors import PlanningError
from gazelle.kinematics.robot_model import RobotModel

_STEPS = 60
_DIFFERENCE = 1e-6  # of a joint, for derivatives [rad]
_DAMPING = 1e-6
_SHARP = 1e-9  # of the direction
_LEAP = 0.5  # of a joint in one step, at most [rad]


@checked(PlanningError)
class Pointing:
    """Finds where joints have to be for an axis of a link to go through a place.

    Levenberg's method on the difference between the axis and the direction to the place, both of
    length one: it holds for any mounting, where the axis does not go through those of the joints.

    Args:
        robot: With the joints.
        joints: Joints that turn the link, the first nearest to the robot's root; two for a head.
        link: Link that points.
        axis: Of the link, of any length.

    Attributes:
        base: The link before the first joint; places are in its frame.

    Raises:
        PlanningError: There is no such joint or link, or the axis is zero.
    """

    def __init__(
        self, robot: RobotModel, joints: Sequence[str], link: str, axis: Sequence[float] = (1, 0, 0)
    ) -> None:
        length = math.hypot(*axis) if len(axis) == 3 and joints else 0.0
        if not length > 0.0:
            raise PlanningError(
                "pointing needs at least one joint and a non-zero axis of three numbers"
            )
        self._robot, self._link = robot, robot.link(link).name
        self._axis = np.asarray(axis, float) / length
        self._columns = robot.columns(joints)
        self.base = robot.joints[joints[0]].parent
        self._low, self._high = (bound[self._columns] for bound in robot.limits())

    def solve(self, place: ArrayLike, start: ArrayLike) -> tuple[Floats, float]:
        """Return positions of the joints, within their limits, and the remaining angle [rad].

        Args:
            place: In the frame of ``base`` [m], shape (3,).
            start: Positions of the joints, shape (joints,).
        """
        target = np.asarray(place, float)
        here = np.clip(np.asarray(start, float), self._low, self._high)
        miss, damping = self._miss(here, target), _DAMPING
        for _ in range(_STEPS):
            if np.linalg.norm(miss) < _SHARP:
                break
            slopes = np.stack(
                [
                    (self._miss(here + _DIFFERENCE * unit, target) - miss) / _DIFFERENCE
                    for unit in np.eye(len(here))
                ],
                axis=1,
            )
            square = slopes.T @ slopes + damping * np.eye(len(here))
            step = np.clip(np.linalg.solve(square, -slopes.T @ miss), -_LEAP, _LEAP)
            there = np.clip(here + step, self._low, self._high)
            then = self._miss(there, target)
            if np.linalg.norm(then) < np.linalg.norm(miss):
                here, miss, damping = there, then, max(damping / 10.0, 1e-12)
            else:
                damping *= 10.0
        return here, self.angle(here, target)

    def angle(self, positions: ArrayLike, place: ArrayLike) -> float:
        """Return the angle between the axis and the direction to a place [rad], see ``solve``."""
        miss = self._miss(np.asarray(positions, float), np.asarray(place, float))
        return 2.0 * math.asin(min(1.0, float(np.linalg.norm(miss)) / 2.0))

    def _miss(self, positions: Floats, place: Floats) -> Floats:
        state = self._robot.zero()
        state[self._columns] = positions
        base, link = self._robot.forward(self._robot.complete(state), [self.base, self._link])
        turned = base[:3, :3].T @ link[:3, :3]
        away = place - base[:3, :3].T @ (link[:3, 3] - base[:3, 3])
        missed: Floats = turned @ self._axis - away / max(float(np.linalg.norm(away)), 1e-12)
        return missed
