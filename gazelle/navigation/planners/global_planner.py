"""``global_planner/GlobalPlanner``: as navfn, with prices and headings to choose."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Final

import numpy as np

from gazelle.argument_checks import checked
from gazelle.array_types import Floats, Floats32
from gazelle.errors import Error
from gazelle.navigation.costmap import Costmap
from gazelle.navigation.costmap.values import NO_INFORMATION
from gazelle.navigation.following import Pose2, wrapped
from gazelle.navigation.planners.navfn import PotentialPlanner
from gazelle.navigation.planners.plugins import Values
from gazelle_ros.base.parameter_values import settings_from

_FORWARD, _INTERPOLATE, _FORWARD_THEN_INTERPOLATE = 1, 2, 3
_SIDES: Final = {
    _FORWARD: 0.0,
    _FORWARD_THEN_INTERPOLATE: 0.0,
    4: math.pi,
    5: -math.pi / 2.0,
    6: math.pi / 2.0,
}
"""Heading less that of the path [rad], by mode; 4 is backward, 5 leftward and 6 rightward."""
_MODES: Final = range(7)
_LIMITS: Final = {
    "lethal_cost": (1, 255),
    "neutral_cost": (1, 255),
    "cost_factor": (0.01, 5.0),
    "orientation_window_size": (1, 255),
}
"""Least and greatest values; others become the nearest ones, as dynamic_reconfigure makes them."""
_STRAIGHT_RAD: Final = 0.35
"""Greatest change of heading between two poses of a straight line."""


@dataclass(frozen=True, slots=True)
class GlobalPlannerSettings:
    """Parameters of ``global_planner``; names and defaults are the original's.

    ``use_dijkstra`` false makes the original look at fewer cells, by A*; the way here is the cheapest
    one in both cases. ``planner_window_x`` and ``planner_window_y`` are not used there either, and the
    outermost cells are closed here whatever ``outline_map`` says.
    """

    allow_unknown: bool = True
    default_tolerance: float = 0.0
    lethal_cost: int = 253
    neutral_cost: int = 50
    cost_factor: float = 3.0
    use_dijkstra: bool = True
    use_quadratic: bool = True
    use_grid_path: bool = False
    old_navfn_behavior: bool = False
    orientation_mode: int = 0
    orientation_window_size: int = 1
    publish_potential: bool = True
    publish_scale: int = 100
    outline_map: bool = True
    planner_window_x: float = 0.0
    planner_window_y: float = 0.0

    def __post_init__(self) -> None:
        for name, (least, most) in _LIMITS.items():
            value = getattr(self, name)
            if math.isnan(value):
                raise Error(f"'{name}' is a number from {least} to {most}, not {value}")
            object.__setattr__(self, name, min(max(value, least), most))
        if self.orientation_mode not in _MODES:
            raise Error(f"'orientation_mode' is 0 to {_MODES[-1]}, not {self.orientation_mode}")
        if not 0 < self.publish_scale <= 100:
            raise Error(f"'publish_scale' is 1 to 100, not {self.publish_scale}")


@checked(Error, after=True)
class GlobalPlanner(PotentialPlanner):
    """The cheapest path, as ``global_planner`` of ROS finds it.

    Parameters: see `GlobalPlannerSettings`. Its plans lead from the very place of the robot to that of
    the goal; with ``old_navfn_behavior`` they begin in the middle of a cell, as navfn's.
    """

    def __init__(self, name: str, costmap: Costmap, parameters: Values) -> None:
        super().__init__(name, costmap, parameters)
        self.settings = settings_from(name, parameters, GlobalPlannerSettings)
        self.quadratic = self.settings.use_quadratic
        self.grid_path = self.settings.use_grid_path
        self.exact_start = not self.settings.old_navfn_behavior

    def prices(self) -> Floats32:
        """Return neutral cost and factor times cost, below lethal; see `PotentialPlanner`."""
        lethal = self.settings.lethal_cost
        costs = np.arange(256, dtype=np.float32)
        table = self.settings.neutral_cost + self.settings.cost_factor * costs
        table = np.minimum(table, lethal - 1.0)
        table[costs >= lethal - 1] = 0.0
        table[NO_INFORMATION] = lethal - 1.0 if self.allow_unknown else 0.0
        prices: Floats32 = table.astype(np.float32)
        return prices

    def oriented(self, plan: Floats, start: Pose2) -> Floats:
        """Return headings by ``orientation_mode``; the goal keeps its own."""
        mode = self.settings.orientation_mode
        if len(plan) < 3:
            return plan
        if mode in _SIDES:
            plan[:-1, 2] = _turned(self._ahead(plan)[:-1], _SIDES[mode])
        if mode in {_INTERPOLATE, _FORWARD_THEN_INTERPOLATE}:
            first = 0 if mode == _INTERPOLATE else _begin_of_last_line(plan[:, 2])
            plan[0, 2] = start[2]
            _interpolate(plan[first:])
        return plan

    def _ahead(self, plan: Floats) -> Floats:
        """Return headings from so many poses before to so many after [rad]."""
        index = np.arange(len(plan))
        window = self.settings.orientation_window_size
        after = plan[np.minimum(index + window, len(plan) - 1), :2]
        apart = after - plan[np.maximum(index - window, 0), :2]
        return np.arctan2(apart[:, 1], apart[:, 0])


def _begin_of_last_line(headings: Floats) -> int:
    """Return the first pose of the straight line that a plan ends with."""
    first = len(headings) - 3
    while first > 0 and abs(wrapped(headings[first - 1] - headings[-3])) <= _STRAIGHT_RAD:
        first -= 1
    return first


def _interpolate(plan: Floats) -> None:
    """Set headings between those of the first and the last pose."""
    first, last = plan[0, 2], plan[-1, 2]
    turn = wrapped(last - first)
    plan[:-1, 2] = _turned(first + turn * np.linspace(0.0, 1.0, len(plan))[:-1], 0.0)


def _turned(headings: Floats, angle: float) -> Floats:
    """Return headings turned by an angle, between -pi and pi."""
    turned: Floats = np.remainder(headings + angle + math.pi, 2.0 * math.pi) - math.pi
    return turned
