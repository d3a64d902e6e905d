"""``navfn/NavfnROS``: the cheapest path over a costmap."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

import numpy as np

from gazelle.argument_checks import checked
from gazelle.array_types import Floats, Floats32
from gazelle.errors import Error
from gazelle.navigation.costmap import Costmap
from gazelle.navigation.costmap.values import INSCRIBED, NO_INFORMATION
from gazelle.navigation.following import Pose2
from gazelle.navigation.planners.plugins import GlobalPlannerPlugin, Values
from gazelle.navigation.planners.potential import NOT_REACHED, PotentialField
from gazelle_ros.base.parameter_values import value_of

_NEUTRAL: Final = 50.0
_FACTOR: Final = 0.8
_UNKNOWN: Final = 253.0
"""Prices of a cell: 50 + 0.8 times its cost; of unknown cells 253."""

NO_PLAN: Final[Floats] = np.zeros((0, 3))


@checked(Error, after=True)
class PotentialPlanner(GlobalPlannerPlugin):
    """Base of planners that descend a potential.

    The potential spreads from the robot, so that goals nearby can be looked at if one is invalid
    reached.

    Attributes:
        quadratic: Whether potentials are solved along both axes, and not only along the cheaper one.
        grid_path: Whether plans go from cell to cell, and not along the gradient.
        exact_start: Whether plans begin where the robot is, and not in the middle of its cell.
        on_potential: Called with the potentials of each plan, shape (rows, columns), if set.
    """

    def __init__(self, name: str, costmap: Costmap, parameters: Values) -> None:
        super().__init__(name, costmap, parameters)
        self.allow_unknown = value_of(parameters, "allow_unknown", True)
        self.tolerance = value_of(parameters, "default_tolerance", 0.0)
        self.quadratic = True
        self.grid_path = False
        self.exact_start = False
        self.on_potential: Callable[[Floats32], None] | None = None
        self._field: PotentialField | None = None

    def traversal_costs(self) -> Floats32:
        """Return the traversal cost of a cell by its cost in the costmap; 0 where it is closed; shape (256,)."""
        table = _NEUTRAL + _FACTOR * np.arange(256, dtype=np.float32)
        table[INSCRIBED:] = 0.0
        table[NO_INFORMATION] = _UNKNOWN if self.allow_unknown else 0.0
        return table.astype(np.float32)

    @checked(Error)
    def make_plan(self, start: Pose2, goal: Pose2, tolerance: float | None = None) -> Floats:
        """Return the cheapest path; see `GlobalPlannerPlugin`."""
        first = self.costmap.cell_of(start[0], start[1])
        last = self.costmap.cell_of(goal[0], goal[1])
        table = self.traversal_costs()
        if first is None or last is None or not table.any():
            return NO_PLAN
        traversal_costs = table.take(self.costmap.cells)
        # The cell of the robot is free, whatever the map has there.
        traversal_costs[first[1], first[0]] = table[0]
        field = self._prepared()
        reach = self.tolerance if tolerance is None else tolerance
        least = float(table[table > 0.0].min())
        self._spread(field, traversal_costs, (first, last), least, everywhere=reach > 0.0)
        if self.on_potential is not None:
            self.on_potential(field.values)
        end = last if reach <= 0.0 else self._nearest(field, last, reach)
        if end is None or field.values[end[1], end[0]] >= NOT_REACHED:
            return NO_PLAN
        cells = field.way_down(end, first, self.grid_path)
        if not len(cells):
            return NO_PLAN
        return self._posed(cells[::-1], start, goal, exact=end == last)

    def _spread(
        self,
        field: PotentialField,
        traversal_costs: Floats32,
        ends: tuple[tuple[int, int], tuple[int, int]],
        least: float,
        *,
        everywhere: bool,
    ) -> None:
        """Find potentials from one cell to another, or everywhere.

        Args:
            field: Of the costmap's shape.
            traversal_costs: Of all cells.
            ends: Columns and rows of the robot and of the goal.
            least: The least traversal cost of an open cell.
            everywhere: Whether cells around a goal out of reach are needed, too.
        """
        field.spread(
            traversal_costs, ends[0], None if everywhere else ends[1], least, self.quadratic
        )

    def _prepared(self) -> PotentialField:
        rows, columns = self.costmap.cells.shape
        if self._field is None or self._field.values.shape != (rows, columns):
            self._field = PotentialField(rows, columns)
        return self._field

    def _nearest(
        self, field: PotentialField, goal: tuple[int, int], reach: float
    ) -> tuple[int, int] | None:
        """Return the cell nearest to the goal that was reached, within a distance [m]."""
        rows, columns = np.nonzero(field.values < NOT_REACHED)
        away = np.hypot(columns - goal[0], rows - goal[1])
        if not len(away) or away.min() * self.costmap.resolution > reach:
            return None
        best = int(away.argmin())
        return int(columns[best]), int(rows[best])

    def _posed(self, cells: Floats, start: Pose2, goal: Pose2, *, exact: bool) -> Floats:
        """Return poses along a path of cells.

        Each but the last one looks ahead by ``oriented``.
        """
        corner = np.array(self.costmap.origin)
        plan = np.zeros((len(cells), 3))
        plan[:, :2] = corner + (cells + 0.5) * self.costmap.resolution
        if exact:
            plan[-1] = goal
        if self.exact_start:
            plan[0, :2] = start[:2]
        plan[-1, 2] = goal[2]
        return self.oriented(plan, start)

    def oriented(self, plan: Floats, start: Pose2) -> Floats:
        """Return the same poses with headings; here they are left 0, as navfn leaves them."""
        del start
        return plan


class NavfnPlanner(PotentialPlanner):
    """``navfn/NavfnROS``: parameters ``allow_unknown``, ``default_tolerance``."""
