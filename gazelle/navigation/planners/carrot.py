"""``carrot_planner/CarrotPlanner``: straight towards the goal, as far as there is room."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from gazelle.array_types import Floats
from gazelle.navigation.costmap import Costmap
from gazelle.navigation.following import Pose2
from gazelle.navigation.planners.navfn import NO_PLAN
from gazelle.navigation.planners.plugins import GlobalPlannerPlugin, Values
from gazelle.navigation.planners.rollout import TrajectoryRollout
from gazelle_ros.base.parameter_values import settings_from

_STEP = 0.01
"""Share of the path by which the end moves back at a time."""


@dataclass(frozen=True, slots=True)
class CarrotSettings:
    """Parameters of ``carrot_planner``, which it reads and does not use, as the original."""

    step_size: float = 0.0
    min_dist_from_robot: float = 0.1


class CarrotPlanner(GlobalPlannerPlugin):
    """A straight path that ends where the robot can stand, at or before the goal.

    The end moves back by a hundredth of the way at a time. Parameters: see `CarrotSettings`.
    """

    def __init__(self, name: str, costmap: Costmap, parameters: Values) -> None:
        super().__init__(name, costmap, parameters)
        settings_from(name, parameters, CarrotSettings)

    def make_plan(self, start: Pose2, goal: Pose2, tolerance: float | None = None) -> Floats:
        """Return a plan of two poses; see `GlobalPlannerPlugin`."""
        del tolerance
        if self.costmap.cell_of(goal[0], goal[1]) is None:
            return NO_PLAN
        rollout = TrajectoryRollout(
            self.costmap.cells,
            self.costmap.origin,
            self.costmap.resolution,
            self.costmap.footprint,
            np.zeros((4, *self.costmap.cells.shape), np.int32),
            np.zeros(6),
            0.0,
        )
        turn = math.remainder(goal[2] - start[2], 2.0 * math.pi)
        for share in 1.0 - _STEP * np.arange(round(1.0 / _STEP)):
            x = start[0] + share * (goal[0] - start[0])
            y = start[1] + share * (goal[1] - start[1])
            heading = start[2] + share * turn
            if rollout.footprint_cost(x, y, heading) >= 0.0:
                return np.array([start, (x, y, heading)], np.float64)
        return NO_PLAN
