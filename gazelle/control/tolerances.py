"""Tolerances of joints on a trajectory."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from gazelle.array_types import Floats
from gazelle.control.parameters import ControllerParameters
from gazelle.control.values import JointTolerance, TrajectoryGoal


@dataclass(frozen=True, slots=True)
class TrajectoryTolerances:
    """Bounds of position, velocity and acceleration; 0 for none.

    Attributes:
        path: On the way, shape (joints, 3).
        goal: At the end, likewise.
        goal_time: Allowed delay of a trajectory's end [s].
    """

    path: Floats
    goal: Floats
    goal_time: float

    @classmethod
    def read(cls, parameters: ControllerParameters, joints: Sequence[str]) -> TrajectoryTolerances:
        """Read ``constraints``."""
        constraints = parameters.part("constraints")
        path, goal = np.zeros((2, len(joints), 3))
        goal[:, 1] = constraints.number("stopped_velocity_tolerance", 0.01)
        for row, name in enumerate(joints):
            path[row, 0] = constraints.number(f"{name}/trajectory", 0.0)
            goal[row, 0] = constraints.number(f"{name}/goal", 0.0)
        return cls(path, goal, constraints.number("goal_time", 0.0))

    def with_goal(self, goal: TrajectoryGoal, joints: Sequence[str]) -> TrajectoryTolerances:
        """Return a goal's tolerances. Positive values replace a bound, negative ones remove it."""
        wait = goal.goal_time_tolerance
        return TrajectoryTolerances(
            _changed(self.path, goal.path_tolerance, joints),
            _changed(self.goal, goal.goal_tolerance, joints),
            wait if wait > 0.0 else 0.0 if wait < 0.0 else self.goal_time,
        )


def _changed(bounds: Floats, changes: Iterable[JointTolerance], joints: Sequence[str]) -> Floats:
    changed = bounds.copy()
    for each in changes:
        if each.name in joints:
            row = list(joints).index(each.name)
            bounds_of_joint = (each.position, each.velocity, each.acceleration)
            for column, value in enumerate(bounds_of_joint):
                if value != 0.0:
                    changed[row, column] = max(value, 0.0)
    return changed
