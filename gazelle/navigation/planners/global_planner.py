"""``global_planner/GlobalPlanner``: as navfn, with traversal costs and headings to choose."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Final

import numpy as np

from gazelle.argument_checks import checked
from gazelle.array_types import Floats, Floats32
from gazelle.errors import Error
from gazelle.navigation.angles import wrapped, wrapped_all
from gazelle.navigation.costmap import Costmap
from gazelle.navigation.costmap.values import NO_INFORMATION
from gazelle.navigation.following import Pose2
from gazelle.navigation.planners.navfn import PotentialPlanner
from gazelle.navigation.planners.plugins import Values
from gazelle.navigation.planners.potential import PotentialField
from gazelle_ros.base.parameter_values import settings_from
from gazelle_ros.base.tuned_fields import tunable, tuned_fields

_FORWARD, _INTERPOLATE, _FORWARD_THEN_INTERPOLATE = 1, 2, 3
_SIDES: Final = {
    _FORWARD: 0.0,
    _FORWARD_THEN_INTERPOLATE: 0.0,
    4: math.pi,
    5: -math.pi / 2.0,
    6: math.pi / 2.0,
}
"""Heading less that of the path [rad], by mode; 4 is backward, 5 leftward and 6 rightward."""
_STRAIGHT_RAD: Final = 0.35
"""Greatest change of heading between two poses of a straight line."""


@dataclass(frozen=True, slots=True)
class GlobalPlannerSettings:
    """Parameters of ``global_planner``; names and defaults are the original's.

    With ``use_dijkstra`` false the traversal cost is the cell's cost and ``neutral_cost``, as there, but costs from
    206 on do not become cheap, which they do there where the sum of both exceeds a byte.
    ``planner_window_x`` and ``planner_window_y`` are not used there either, and the outermost cells are
    closed here whatever ``outline_map`` says.
    """

    allow_unknown: bool = True
    default_tolerance: float = 0.0
    lethal_cost: int = tunable(253, 1, 255, "cost from which a cell is closed")
    neutral_cost: int = tunable(50, 1, 255, "traversal cost of a free cell")
    cost_factor: float = tunable(3.0, 0.01, 5.0, "factor of the cost of the costmap")
    use_dijkstra: bool = True
    use_quadratic: bool = True
    use_grid_path: bool = False
    old_navfn_behavior: bool = False
    orientation_mode: int = tunable(
        1, 0, 6, "0 none, 1 forward, 2 interpolate, 3 both, 4 backward, 5 leftward, 6 rightward"
    )
    orientation_window_size: int = tunable(1, 1, 255, "poses to each side that give a heading")
    publish_potential: bool = tunable(default=True, description="publish the potential of plans")
    publish_scale: int = 100
    outline_map: bool = True
    planner_window_x: float = 0.0
    planner_window_y: float = 0.0

    def __post_init__(self) -> None:
        if math.isnan(self.cost_factor):
            raise Error(f"'cost_factor' must be a number from 0.01 to 5.0, not {self.cost_factor}")
        for each in tuned_fields(GlobalPlannerSettings).values():
            object.__setattr__(self, each.name, each.clamp(getattr(self, each.name)))
        if not 0 < self.publish_scale <= 100:
            raise Error(f"'publish_scale' must be 1 to 100, not {self.publish_scale}")


@checked(Error, after=True)
class GlobalPlanner(PotentialPlanner):
    """The cheapest path, as ``global_planner`` of ROS finds it.

    Parameters: see `GlobalPlannerSettings`. Its plans lead from the very place of the robot to that of
    the goal; with ``old_navfn_behavior`` they begin in the middle of a cell, as navfn's.
    """

    def __init__(self, name: str, costmap: Costmap, parameters: Values) -> None:
        super().__init__(name, costmap, parameters)
        self.settings = settings_from(name, parameters, GlobalPlannerSettings)
        self.dijkstra = self.settings.use_dijkstra
        self.quadratic = self.settings.use_quadratic
        self.grid_path = self.settings.use_grid_path
        self.exact_start = not self.settings.old_navfn_behavior

    def traversal_costs(self) -> Floats32:
        """Return neutral cost and factor times cost, below lethal; see `PotentialPlanner`."""
        lethal, neutral = self.settings.lethal_cost, self.settings.neutral_cost
        costs = np.arange(256, dtype=np.float32)
        if self.dijkstra:
            table = np.minimum(neutral + self.settings.cost_factor * costs, lethal - 1.0)
            table[costs >= lethal - 1] = 0.0
            unknown = lethal - 1.0
        else:
            table = neutral + costs
            table[costs >= lethal] = 0.0
            unknown = neutral + float(NO_INFORMATION)
        table[NO_INFORMATION] = unknown if self.allow_unknown else 0.0
        traversal_costs: Floats32 = table.astype(np.float32)
        return traversal_costs

    def _spread(
        self,
        field: PotentialField,
        traversal_costs: Floats32,
        ends: tuple[tuple[int, int], tuple[int, int]],
        least: float,
        *,
        everywhere: bool,
    ) -> None:
        """Find potentials, by A* where ``use_dijkstra`` is false; see `PotentialPlanner`."""
        if self.dijkstra:
            super()._spread(field, traversal_costs, ends, least, everywhere=everywhere)
        else:
            field.search(traversal_costs, *ends, float(self.settings.neutral_cost), self.quadratic)

    def oriented(self, plan: Floats, start: Pose2) -> Floats:
        """Return headings by ``orientation_mode``; the goal keeps its own."""
        mode = self.settings.orientation_mode
        if len(plan) < 3:
            return plan
        if mode in _SIDES:
            plan[:-1, 2] = wrapped_all(self._ahead(plan)[:-1] + _SIDES[mode])
        if mode in {_INTERPOLATE, _FORWARD_THEN_INTERPOLATE}:
            first = 0 if mode == _INTERPOLATE else _begin_of_last_line(plan[:, 2])
            plan[0, 2] = start[2]
            _interpolate(plan[first:])
        return plan

    def _ahead(self, plan: Floats) -> Floats:
        """Return headings averaged over a window of poses [rad]."""
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
    plan[:-1, 2] = wrapped_all(first + turn * np.linspace(0.0, 1.0, len(plan))[:-1])
