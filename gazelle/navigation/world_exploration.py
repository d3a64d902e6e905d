"""Exploration of one world by one robot, in process: an `Explorer` that sends goals to a `MoveBase`."""

from __future__ import annotations

import math

import numpy as np

from gazelle.description.occupancy import FREE, OccupancyMap
from gazelle.navigation.costmap.values import FREE_SPACE, LETHAL, NO_INFORMATION
from gazelle.navigation.exploration import Explorer, ExploreSettings, Place
from gazelle.navigation.following import Pose2
from gazelle.navigation.frontiers import find_frontiers
from gazelle.navigation.move_base import GoalOutcome, MoveBase


class WorldExploration:
    """Sends a robot from frontier to frontier.

    Args:
        settings: As of ``explore_lite``.
    """

    def __init__(self, settings: ExploreSettings) -> None:
        self._settings = settings
        self._explorer: Explorer | None = None
        self._place: Place | None = None
        self._due = -math.inf

    def ended(self, outcome: GoalOutcome) -> None:
        """Handle the end of the last goal; the next one is chosen at once."""
        if (
            outcome is GoalOutcome.ABORTED
            and self._explorer is not None
            and self._place is not None
        ):
            self._explorer.give_up(self._place)
        self._due = -math.inf

    def step(self, time: float, pose: Pose2, grid: OccupancyMap, law: MoveBase) -> bool:
        """Choose a goal if one is due; returns whether exploration is complete.

        Args:
            time: Now [s].
            pose: Of the robot on the map.
            grid: The map.
            law: Law that gets the goals.
        """
        if time < self._due - 1e-6:
            return False
        self._due = time + 1.0 / self._settings.planner_frequency
        if self._explorer is None:
            self._explorer = Explorer(self._settings, grid.resolution)
        costs = np.where(grid.data == FREE, FREE_SPACE, LETHAL).astype(np.uint8)
        costs[grid.data < 0] = NO_INFORMATION
        corner = grid.origin.x, grid.origin.y
        least = self._settings.min_frontier_size
        goal = self._explorer.decide(
            time, find_frontiers(costs, corner, grid.resolution, pose[:2], least)
        )
        if goal.place is None:
            return True
        if goal.fresh or law.goal is None:
            self._place = x, y = goal.place
            law.set_goal((x, y, math.atan2(y - pose[1], x - pose[0])), time)
        return False
