"""``global_planner/GlobalPlanner``: as navfn, with prices and headings to choose."""

from __future__ import annotations

import math

import numpy as np

from gazelle.array_types import Floats, Floats32
from gazelle.navigation.costmap import Costmap
from gazelle.navigation.costmap.values import NO_INFORMATION
from gazelle.navigation.following import Pose2
from gazelle.navigation.planners.navfn import PotentialPlanner, heading_along, turned
from gazelle.navigation.planners.plugins import Values
from gazelle_ros.base.parameter_values import value_of

_SIDES = {4: math.pi, 5: math.pi / 2.0, 6: -math.pi / 2.0}
"""Modes in which the robot goes backward, or with its left or right side ahead."""


class GlobalPlanner(PotentialPlanner):
    """The cheapest path, as ``global_planner`` of ROS finds it.

    Parameters: ``allow_unknown``, ``default_tolerance``, ``lethal_cost`` 253, ``neutral_cost`` 50,
    ``cost_factor`` 3, ``use_quadratic``, ``use_grid_path``, ``orientation_mode`` (0 none, 1 forward, 2
    interpolate, 3 forward then interpolate, 4 backward, 5 leftward, 6 rightward),
    ``orientation_window_size``. ``use_dijkstra`` false only makes the original look at fewer cells; the
    way here is the cheapest one in both cases.
    """

    def __init__(self, name: str, costmap: Costmap, parameters: Values) -> None:
        super().__init__(name, costmap, parameters)
        self._lethal = value_of(parameters, "lethal_cost", 253)
        self._neutral = value_of(parameters, "neutral_cost", 50)
        self._factor = value_of(parameters, "cost_factor", 3.0)
        self._mode = value_of(parameters, "orientation_mode", 0)
        self._window = value_of(parameters, "orientation_window_size", 1)
        self.quadratic = value_of(parameters, "use_quadratic", True)
        self.grid_path = value_of(parameters, "use_grid_path", False)

    def prices(self) -> Floats32:
        """Return neutral cost and factor times cost, below lethal; see `PotentialPlanner`."""
        costs = np.arange(256, dtype=np.float32)
        table = np.minimum(self._neutral + self._factor * costs, self._lethal - 1.0)
        table[costs >= self._lethal - 1] = 0.0
        table[NO_INFORMATION] = self._lethal - 1.0 if self.allow_unknown else 0.0
        prices: Floats32 = table.astype(np.float32)
        return prices

    def oriented(self, plan: Floats, start: Pose2) -> Floats:
        """Return headings by ``orientation_mode``; the goal keeps its own."""
        if self._mode == 0 or len(plan) < 3:
            return plan
        goal = plan[-1, 2]
        ahead = heading_along(plan)
        if self._window > 1:
            ahead = self._smoothed(plan)
        if self._mode in {1, 3}:
            plan[:, 2] = ahead
        elif self._mode in _SIDES:
            plan[:, 2] = turned(ahead, _SIDES[self._mode])
        elif self._mode == 2:
            plan[:, 2] = self._interpolated(start[2], goal, len(plan))
        if self._mode == 3:
            count = max(len(plan) // 2, 2)
            plan[-count:, 2] = self._interpolated(plan[-count, 2], goal, count)
        plan[-1, 2] = goal
        return plan

    def _smoothed(self, plan: Floats) -> Floats:
        """Return headings from so many poses before to so many after."""
        count = len(plan)
        index = np.arange(count)
        after = plan[np.minimum(index + self._window, count - 1), :2]
        before = plan[np.maximum(index - self._window, 0), :2]
        apart = after - before
        return np.arctan2(apart[:, 1], apart[:, 0])

    @staticmethod
    def _interpolated(first: float, last: float, count: int) -> Floats:
        turn = math.remainder(last - first, 2.0 * math.pi)
        return turned(first + turn * np.linspace(0.0, 1.0, count), 0.0)
