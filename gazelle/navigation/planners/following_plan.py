"""Base of local planners: the part of a plan that is in the local window."""

from __future__ import annotations

import numpy as np

from gazelle.argument_checks import checked
from gazelle.array_types import Floats, Indices
from gazelle.errors import Error
from gazelle.navigation.costmap import Costmap
from gazelle.navigation.costmap.values import NO_INFORMATION
from gazelle.navigation.following import Pose2
from gazelle.navigation.planners.planar import composed, moved
from gazelle.navigation.planners.plugins import LocalPlannerPlugin, Values

_PASSED = 1.0
"""Poses before the first one this near to the robot were passed [m]."""


@checked(Error, after=True)
class PlanFollower(LocalPlannerPlugin):
    """Holds a plan and returns its part near the robot.

    Attributes:
        prune: Whether poses that were passed are forgotten.
    """

    def __init__(self, name: str, costmap: Costmap, parameters: Values, period: float) -> None:
        super().__init__(name, costmap, parameters, period)
        self.prune = False
        self._plan: Floats = np.zeros((0, 3))

    @property
    def has_plan(self) -> bool:
        """True if there is a plan."""
        return len(self._plan) > 0

    def set_plan(self, plan: Floats) -> bool:
        """Set a plan in the global frame.

        Raises:
            Error: It has another shape, or a number that is not finite.
        """
        poses = np.array(plan, np.float64)
        if poses.ndim != 2 or poses.shape[1] != 3 or not np.isfinite(poses).all():
            raise Error(
                f"a plan must be finite poses, shape (n, 3), not of the shape {poses.shape}"
            )
        self._plan = poses
        return len(poses) > 0

    def goal(self, to_local: Pose2) -> Pose2:
        """Return the end of the plan in the costmap's frame."""
        x, y, heading = self._plan[-1].tolist()
        return composed(to_local, (x, y, heading))

    def local(self, pose: Pose2, to_local: Pose2) -> Floats:
        """Return the part of the plan within half a window of the robot, in the costmap's frame."""
        plan = moved(self._plan, to_local)
        away = np.hypot(plan[:, 0] - pose[0], plan[:, 1] - pose[1])
        rows, columns = self.costmap.cells.shape
        near = away <= max(rows, columns) * self.costmap.resolution / 2.0
        if not near.any():
            return plan[:0]
        first = int(near.argmax())
        beyond = np.flatnonzero(~near[first:])
        last = first + int(beyond[0]) if len(beyond) else len(plan)
        if self.prune:
            passed = int((away[first:last] < _PASSED).argmax())
            self._plan = self._plan[first + passed :]
            first += passed
        return plan[first:last]

    def cells_of(self, plan: Floats) -> Indices:
        """Return the cells of a plan, from its first one on the map until it leaves it.

        Returns:
            Columns and rows, shape (n, 2), one at least.
        """
        side = self.costmap.resolution
        points = _dense(plan[:, :2], side)
        cells = np.floor((points - np.array(self.costmap.origin)) / side).astype(np.intp)
        rows, columns = self.costmap.cells.shape
        on_map = (cells >= 0).all(axis=1) & (cells[:, 0] < columns) & (cells[:, 1] < rows)
        x, y = np.clip(cells, 0, (columns - 1, rows - 1)).T
        known = on_map & (self.costmap.cells[y, x] != NO_INFORMATION)
        if not known.any():
            return np.array([[x[-1], y[-1]]], np.intp)
        first = int(known.argmax())
        off = np.flatnonzero(~known[first:])
        last = first + int(off[0]) if len(off) else len(cells)
        return np.ascontiguousarray(cells[first:last])


def _dense(points: Floats, spacing: float) -> Floats:
    """Return the same path with points no farther apart than this."""
    if len(points) < 2:
        return points
    lengths = np.hypot(*np.diff(points, axis=0).T)
    counts = np.maximum(np.ceil(lengths / spacing).astype(int), 1)
    which = np.repeat(np.arange(len(counts)), counts)
    index = np.arange(len(which)) - np.repeat(np.cumsum(counts) - counts, counts)
    share = (index / counts[which])[:, None]
    between = points[which] * (1.0 - share) + points[which + 1] * share
    return np.vstack((between, points[-1:]))
