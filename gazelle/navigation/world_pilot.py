"""The stack of one robot in one world: costmaps, state machine, and where the robot is."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from gazelle.array_types import Floats
from gazelle.description.occupancy import OccupancyMap
from gazelle.navigation.costmap import Layer, ObstacleLayer, StaticLayer
from gazelle.navigation.costmap.values import LETHAL
from gazelle.navigation.exploration import ExploreSettings
from gazelle.navigation.following import Pose2
from gazelle.navigation.live_map import LiveMap
from gazelle.navigation.localization import Localizer, PlanarScan
from gazelle.navigation.move_base import GoalOutcome, NavigationStack, RobotState
from gazelle.navigation.planners.planar import composed, inverse
from gazelle.navigation.planners.plugins import STOP, Velocity
from gazelle.navigation.right_of_way import RightOfWaySettings
from gazelle.navigation.waiting_places import RobotDisc, WaitingPlaceMap
from gazelle.navigation.world_exploration import WorldExploration

EXPLORED = "Exploration stopped."
"""The message of explore_lite."""
_ASIDE = 0.1
"""Tolerance of a position [m]."""


class WorldPilot:
    """The stack of a robot in one world.

    Args:
        stack: Costmaps and state machine.
        grid: The map; None for one that is built while driving.
        height: Of the laser [m].
        localizer: Estimates the pose, and may build the map; None for the true pose.
        name: Of the robot.
        right_of_way: Settings for `RightOfWay`.

    Attributes:
        outcome: Outcome of the last goal.
        text: Its message.
        path: The last global plan to the goal, shape (n, 3): x, y and heading [m, rad].
        grid: The map; None before the first scan of one that is built while driving.
        aside: Whether it stands where it was sent aside.
    """

    def __init__(
        self,
        stack: NavigationStack,
        grid: OccupancyMap | None,
        height: float,
        localizer: Localizer | LiveMap | None,
        name: str,
        right_of_way: RightOfWaySettings,
    ) -> None:
        self.name, self.right_of_way = name, right_of_way
        self._stack, self._height, self._localizer = stack, height, localizer
        self._due = -math.inf
        self._seen = -1
        self.outcome: GoalOutcome | None = None
        self.text = ""
        self.path: Floats = np.zeros((0, 3))
        self._exploration: WorldExploration | None = None
        self._pose: Pose2 | None = None
        self._local_pose: Pose2 = (0.0, 0.0, 0.0)
        self._put_off: Pose2 | None = None
        self._waiting_place: Pose2 | None = None
        self.aside = False
        self.grid = grid
        if grid is not None:
            self._lay(grid)

    def _lay(self, grid: OccupancyMap) -> None:
        """Use a map from now on."""
        self.grid = grid
        for setup in (self._stack.whole, self._stack.local):
            for layer in setup.costmap.layers:
                if isinstance(layer, StaticLayer):
                    layer.set_map(grid, setup.costmap)

    @property
    def goal(self) -> Pose2 | None:
        """Goal pose: x, y and heading [m, rad]; None without one."""
        return self._stack.move_base.goal if self._put_off is None else self._put_off

    @property
    def busy(self) -> bool:
        """True if it has a goal, or explores."""
        return self.goal is not None or self._exploration is not None

    @property
    def makes_way(self) -> bool:
        """True if it yields to others: not if it builds its map, whose frame is its own."""
        explores = self._exploration is not None or isinstance(self._localizer, LiveMap)
        return self.right_of_way.enabled and not explores

    @property
    def body(self) -> RobotDisc | None:
        """Footprint at the pose of its last cycle; None before."""
        if self._pose is None:
            return None
        costmap = self._stack.whole.costmap
        return RobotDisc(*self._pose[:2], costmap.inscribed, costmap.circumscribed)

    def go(self, goal: Pose2, time: float) -> None:
        """Set a goal."""
        self.outcome, self.text, self.path = None, "", np.zeros((0, 3))
        self._exploration = None
        self._end_encounter()
        self._stack.move_base.set_goal(goal, time)

    def explore(self, settings: ExploreSettings) -> None:
        """Explore frontiers of the map until none is left."""
        self.outcome, self.text, self.path = None, "", np.zeros((0, 3))
        self._end_encounter()
        self._stack.move_base.cancel()
        self._exploration = WorldExploration(settings)

    def cancel(self) -> None:
        """Cancel the goal."""
        self._exploration = None
        self._end_encounter()
        self._stack.move_base.cancel()

    # Yielding; see `RightOfWay` --------------------------------------------------------------

    def stand(self) -> None:
        """Wait, with the goal deferred."""
        self._put_off, self._waiting_place, self.aside = self.goal, None, False
        self._stack.move_base.cancel()

    def step_aside(self, x: float, y: float, time: float) -> None:
        """Move to a place and wait there, in whatever heading."""
        heading = 0.0 if self._pose is None else self._pose[2]
        self._waiting_place, self.aside = (x, y, heading), False
        self._clear_global_obstacles()
        self._stack.move_base.set_goal(self._waiting_place, time)

    def go_on(self, time: float, known: WaitingPlaceMap, others: Sequence[RobotDisc]) -> None:
        """Resume the deferred goal, and clear observations of neither the map nor robots.

        Where others stood their outlines stay else, as a beam that meets nothing takes none away. Walls
        and robots beside and behind this one are kept, as it may not see them again.
        """
        goal = self._put_off
        self._end_encounter()
        if goal is None or self._pose is None:
            return
        self._clear_global_obstacles()
        local = self._stack.local.costmap
        rows, columns = np.nonzero(local.cells == LETHAL)
        cells = np.stack((columns, rows), axis=1)
        seen = np.array(local.origin) + (cells + 0.5) * local.resolution
        x, y, turn = composed(self._pose, inverse(self._local_pose))
        cos, sin = math.cos(turn), math.sin(turn)
        places = seen @ np.array([[cos, sin], [-sin, cos]]) + (x, y)
        kept = known.has(places)
        for other in others:
            kept |= np.hypot(*(places - (other.x, other.y)).T) < other.circumscribed + _ASIDE
        names = [layer.name for layer in local.layers if isinstance(layer, ObstacleLayer)]
        for spot in seen[~kept].tolist():
            local.clear((*spot, 0.0), 0.1 * local.resolution, names, outside=False)
        self._stack.move_base.set_goal(goal, time)

    def _end_encounter(self) -> None:
        self._put_off, self._waiting_place, self.aside = None, None, False

    def _clear_global_obstacles(self) -> None:
        """Clear all obstacles of the global costmap: others have moved since they were seen."""
        for layer in self._stack.whole.costmap.layers:
            if isinstance(layer, ObstacleLayer):
                layer.reset()

    def cycle(
        self,
        time: float,
        true: Pose2,
        odom: Pose2,
        speed: Velocity,
        scan: PlanarScan,
        stamp: int,
    ) -> Velocity | None:
        """Run a cycle; returns the velocity to command, None to leave it.

        Args:
            time: Now [s].
            true: True pose of the robot.
            odom: Pose by odometry.
            speed: Its speed.
            scan: The last one.
            stamp: Time of the scan [ns].
        """
        whole_pose, local_pose = self._place(time, true, odom, scan, fresh=stamp != self._seen)
        self._pose, self._local_pose = whole_pose, local_pose
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
        if self._put_off is not None and (
            self._waiting_place is None or self._is_aside(whole_pose)
        ):
            return STOP
        step = stack.move_base.update(time, RobotState(whole_pose, local_pose, speed))
        if step.plan is not None:
            self.path = step.plan
        if step.outcome is not None and self._exploration is not None:
            self._exploration.ended(step.outcome)
        elif step.outcome is not None and self._waiting_place is not None:
            stack.move_base.set_goal(
                self._waiting_place, time
            )  # those behind it may have moved by now
        elif step.outcome is not None:
            self.outcome, self.text = step.outcome, step.text
        return step.velocity

    def _is_aside(self, pose: Pose2) -> bool:
        """Return whether it has reached its waiting place; its heading there does not matter."""
        waiting_place = self._waiting_place
        if waiting_place is not None and not self.aside:
            self.aside = math.dist(waiting_place[:2], pose[:2]) < _ASIDE
            if self.aside:
                self._stack.move_base.cancel()
        return self.aside

    def _explored(self, exploration: WorldExploration, time: float, pose: Pose2) -> bool:
        """Return whether nothing is left to explore; if so, the robot stops."""
        law, grid = self._stack.move_base, self.grid
        if grid is None or not exploration.step(time, pose, grid, law):
            return False
        self.cancel()
        self.outcome, self.text = GoalOutcome.SUCCEEDED, EXPLORED
        return True

    def _place(
        self, time: float, true: Pose2, odom: Pose2, scan: PlanarScan, *, fresh: bool
    ) -> tuple[Pose2, Pose2]:
        """Return the robot's pose on the map and in the local costmap's frame."""
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
        """Process a scan, and the map if there is a new one."""
        if isinstance(localizer, Localizer):
            localizer.update(odom, scan)
            return
        grid = localizer.update(time, odom, scan)
        if grid is not None:
            self._lay(grid)


def _ends(scan: PlanarScan, height: float) -> Floats:
    """Return the ends of beams in the robot's frame, shape (n, 3) [m]."""
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
    """Pass a scan to the layers that use observations."""
    cos, sin = math.cos(pose[2]), math.sin(pose[2])
    turn = np.array([[cos, sin], [-sin, cos]])
    moved = points.copy()
    moved[:, :2] = points[:, :2] @ turn + pose[:2]
    eye = composed(pose, scan.laser)
    for layer in layers:
        if isinstance(layer, ObstacleLayer):
            for source in layer.sources:
                layer.observe(source, time, np.array([eye[0], eye[1], height]), moved)
