"""The stack of one robot in one world: costmaps, state machine, and where the robot is."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from gazelle.array_types import Floats
from gazelle.description.occupancy import OccupancyMap
from gazelle.navigation.costmap import Layer, ObstacleLayer, StaticLayer
from gazelle.navigation.exploration import ExploreSettings
from gazelle.navigation.following import Pose2
from gazelle.navigation.live_map import LiveMap
from gazelle.navigation.localization import Localizer, PlanarScan
from gazelle.navigation.move_base import GoalOutcome, NavigationStack, RobotState
from gazelle.navigation.planners.planar import composed
from gazelle.navigation.planners.plugins import STOP, Velocity
from gazelle.navigation.world_exploration import WorldExploration

EXPLORED = "Exploration stopped."
"""As explore_lite says it."""


class WorldPilot:
    """The stack of a robot in one world.

    Args:
        stack: Costmaps and state machine.
        grid: The map; None for one that is made on the way.
        height: Of the laser [m].
        localizer: Says where the robot is, and may make the map; None for the truth.

    Attributes:
        outcome: How the last goal ended.
        text: What was said of it.
        path: The last global plan to the goal, shape (n, 3): x, y and heading [m, rad].
        grid: The map; None before the first scan of one that is made on the way.
    """

    def __init__(
        self,
        stack: NavigationStack,
        grid: OccupancyMap | None,
        height: float,
        localizer: Localizer | LiveMap | None,
    ) -> None:
        self._stack, self._height, self._localizer = stack, height, localizer
        self._due = -math.inf
        self._seen = -1
        self.outcome: GoalOutcome | None = None
        self.text = ""
        self.path: Floats = np.zeros((0, 3))
        self._exploration: WorldExploration | None = None
        self.grid = grid
        if grid is not None:
            self._lay(grid)

    def _lay(self, grid: OccupancyMap) -> None:
        """Work on a map from now on."""
        self.grid = grid
        for setup in (self._stack.whole, self._stack.local):
            for layer in setup.costmap.layers:
                if isinstance(layer, StaticLayer):
                    layer.set_map(grid, setup.costmap)

    @property
    def goal(self) -> Pose2 | None:
        """Where it goes: x, y and heading [m, rad]."""
        return self._stack.move_base.goal

    @property
    def busy(self) -> bool:
        """Whether it has a goal, or explores."""
        return self._stack.move_base.goal is not None or self._exploration is not None

    def go(self, goal: Pose2, time: float) -> None:
        """Go there."""
        self.outcome, self.text, self.path = None, "", np.zeros((0, 3))
        self._exploration = None
        self._stack.move_base.set_goal(goal, time)

    def explore(self, settings: ExploreSettings) -> None:
        """Go from frontier to frontier of the map until none is left."""
        self.outcome, self.text, self.path = None, "", np.zeros((0, 3))
        self._stack.move_base.cancel()
        self._exploration = WorldExploration(settings)

    def cancel(self) -> None:
        """Have no goal."""
        self._exploration = None
        self._stack.move_base.cancel()

    def cycle(
        self,
        time: float,
        true: Pose2,
        odom: Pose2,
        speed: Velocity,
        scan: PlanarScan,
        stamp: int,
    ) -> Velocity | None:
        """Take a cycle; returns the velocity to have, None to leave it.

        Args:
            time: Now [s].
            true: True pose of the robot.
            odom: Pose by odometry.
            speed: That it has.
            scan: The last one.
            stamp: When it was taken [ns].
        """
        whole_pose, local_pose = self._place(time, true, odom, scan, fresh=stamp != self._seen)
        stack = self._stack
        if stamp != self._seen:
            self._seen = stamp
            points = _ends(scan, self._height)
            _observe(stack.whole.costmap.layers, time, points, whole_pose, scan, self._height)
            _observe(stack.local.costmap.layers, time, points, local_pose, scan, self._height)
        if time >= self._due - 1e-6:
            self._due = time + 1.0 / stack.whole.update_frequency
            stack.whole.costmap.update(whole_pose)
        stack.local.costmap.update(local_pose)
        if self._exploration is not None and self._explored(self._exploration, time, whole_pose):
            return STOP
        step = stack.move_base.update(time, RobotState(whole_pose, local_pose, speed))
        if step.plan is not None:
            self.path = step.plan
        if step.outcome is not None and self._exploration is not None:
            self._exploration.ended(step.outcome)
        elif step.outcome is not None:
            self.outcome, self.text = step.outcome, step.text
        return step.velocity

    def _explored(self, exploration: WorldExploration, time: float, pose: Pose2) -> bool:
        """Whether nothing is left to explore; it stands then."""
        law, grid = self._stack.move_base, self.grid
        if grid is None or not exploration.step(time, pose, grid, law):
            return False
        self.cancel()
        self.outcome, self.text = GoalOutcome.SUCCEEDED, EXPLORED
        return True

    def _place(
        self, time: float, true: Pose2, odom: Pose2, scan: PlanarScan, *, fresh: bool
    ) -> tuple[Pose2, Pose2]:
        """Where the robot is on the map and in the local costmap's frame."""
        localizer = self._localizer
        if localizer is None:
            return true, true
        if fresh:
            self._locate(localizer, time, odom, scan)
        place = localizer.map_to_odom
        return (true if place is None else composed(place, odom)), odom

    def _locate(
        self, localizer: Localizer | LiveMap, time: float, odom: Pose2, scan: PlanarScan
    ) -> None:
        """Take a scan, and the map if there is a new one."""
        if isinstance(localizer, Localizer):
            localizer.update(odom, scan)
            return
        grid = localizer.update(time, odom, scan)
        if grid is not None:
            self._lay(grid)


def _ends(scan: PlanarScan, height: float) -> Floats:
    """Ends of beams in the robot's frame, shape (n, 3) [m]."""
    good = (scan.ranges >= scan.range_min) & (scan.ranges < scan.range_max)
    turned = scan.angles[good] + scan.laser[2]
    points = np.full((int(good.sum()), 3), height)
    points[:, 0] = scan.laser[0] + scan.ranges[good] * np.cos(turned)
    points[:, 1] = scan.laser[1] + scan.ranges[good] * np.sin(turned)
    return points


def _observe(
    layers: Sequence[Layer],
    time: float,
    points: Floats,
    pose: Pose2,
    scan: PlanarScan,
    height: float,
) -> None:
    """Show what was seen to the layers that see."""
    cos, sin = math.cos(pose[2]), math.sin(pose[2])
    turn = np.array([[cos, sin], [-sin, cos]])
    moved = points.copy()
    moved[:, :2] = points[:, :2] @ turn + pose[:2]
    eye = composed(pose, scan.laser)
    for layer in layers:
        if isinstance(layer, ObstacleLayer):
            for source in layer.sources:
                layer.observe(source, time, np.array([eye[0], eye[1], height]), moved)
