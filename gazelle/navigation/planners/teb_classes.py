"""Homotopy classes of timed elastic bands: by which side of each obstacle they pass.

Method: C. Roesmann, F. Hoffmann and T. Bertram, "Integrated online trajectory planning and optimization
in distinctive topologies", Robotics and Autonomous Systems 88, 2017. Bands of a class turn by the same
angle around each obstacle. The shortest path of each class comes from Dijkstra's search over pairs of a
point and a class: S. Bhattacharya et al., "Search-based path planning with homotopy class constraints",
AAAI 2010.
"""

from __future__ import annotations

import heapq
import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from gazelle.array_types import Bools, Floats
from gazelle.navigation.angles import wrapped_all
from gazelle.navigation.following import Pose2
from gazelle.navigation.frontiers import connected_cells
from gazelle.navigation.planners.teb_cost import Band
from gazelle.navigation.planners.teb_obstacles import BandObstacle, ObstacleDistances
from gazelle.navigation.planners.teb_settings import TebSettings

PathClass = tuple[int, ...]
"""Turns around each standing obstacle, and the sides on which moving ones are passed."""

_SIDE = 0.2 * math.pi  # A moving obstacle that turns by less around the robot is not passed [rad]
_SPACING = 0.1  # Between points where an edge is checked for obstacles [m]
_MOST_STEPS = 400


@dataclass(frozen=True, slots=True)
class PassedObstacles:
    """Points that bands pass on one side or the other.

    Attributes:
        standing: One inside of each group of cells, or shape, shape (n, 2) [m].
        keypoints: Ends of them across the way, both sides of each, shape (m, 2) [m].
        moving: Other obstacles.
    """

    standing: Floats
    keypoints: Floats
    moving: Sequence[BandObstacle] = ()

    @classmethod
    def of(
        cls,
        obstacles: ObstacleDistances,
        gap: float,
        moving: Sequence[BandObstacle],
        across: Floats,
    ) -> PassedObstacles:
        """Return the obstacles of a grid and of shapes.

        Args:
            obstacles: Standing obstacles.
            gap: Cells less than twice this apart are one obstacle [m].
            moving: Obstacles that move.
            across: Direction in which a band passes beside them.
        """
        points = [] if obstacles.values is None else _groups(obstacles, obstacles.values <= gap)
        points += [each.corners for each in obstacles.shapes]
        middles, ends = np.zeros((0, 2)), np.zeros((0, 2))
        if points:
            middles = np.array([own[_nearest(own)] for own in points])
            sides = [own @ across for own in points]
            ends = np.array(
                [own[at] for own, side in zip(points, sides, strict=True)
                 for at in (side.argmin(), side.argmax())]
            )  # fmt: skip
        return cls(middles, ends, moving)

    def class_of(self, band: Band) -> PathClass:
        """Return the class of a band."""
        angles = _angles(band.poses[:, None, :2] - self.standing)
        turned = wrapped_all(np.diff(angles, axis=0)).sum(axis=0)
        sides = []
        for each in self.moving:
            seen = _angles(
                band.poses[:, :2] - each.middle - band.arrivals()[:, None] * each.velocity
            )
            about = float(wrapped_all(np.diff(seen)).sum())
            sides.append(0 if abs(about) < _SIDE else int(math.copysign(1.0, about)))
        return (*_whole_turns(turned, angles[-1] - angles[0]), *sides)

    def expected(self, start: Pose2, speed: float) -> Floats:
        """Return the standing ones, and where moving ones are once the robot would be there."""
        met = []
        for each in self.moving:
            time = float(np.hypot(*(each.middle - np.array(start[:2])))) / speed
            met.append(each.middle + time * each.velocity)
        return np.vstack((self.standing, *met)) if met else self.standing


def paths_of_classes(
    start: Pose2,
    goal: Pose2,
    passed: PassedObstacles,
    obstacles: ObstacleDistances,
    settings: TebSettings,
    rng: np.random.Generator,
) -> list[Floats]:
    """Return the shortest paths over some points, one of each class, the shortest first.

    Args:
        start: Pose of the robot.
        goal: End of the paths.
        passed: Obstacles that separate the classes.
        obstacles: Distances, of which paths keep ``min_obstacle_dist``.
        settings: Of the planner.
        rng: Draws the points.

    Returns:
        At most ``max_number_classes`` paths of poses without the start, shape (n, 3).
    """
    if math.dist(start[:2], goal[:2]) < settings.xy_goal_tolerance:
        return []
    nodes = _nodes(start, goal, passed, settings, rng)
    middles = passed.expected(start, settings.max_vel_x)
    edges = _edges(nodes, obstacles, settings)
    found = []
    for path in _shortest(nodes, edges, middles, settings.max_number_classes):
        points = nodes[list(path)]
        ahead = np.arctan2(*np.diff(points, axis=0).T[::-1])
        poses = np.column_stack((points[1:], ahead))
        poses[-1, 2] = goal[2]
        found.append(poses)
    return found


def _nodes(
    start: Pose2,
    goal: Pose2,
    passed: PassedObstacles,
    settings: TebSettings,
    rng: np.random.Generator,
) -> Floats:
    """Return the start, points between, and the goal, shape (n, 2)."""
    s = settings
    ends = np.array([start[:2], goal[:2]])
    way = ends[1] - ends[0]
    length = float(np.hypot(*way))
    ahead = way / length
    across = np.array([-ahead[1], ahead[0]])
    if s.simple_exploration:
        off = s.min_obstacle_dist + s.obstacle_keypoint_offset
        sides = np.where(np.arange(len(passed.keypoints)) % 2 == 0, -off, off)
        points = passed.keypoints + sides[:, None] * across
    else:
        drawn = rng.uniform(size=(s.roadmap_graph_no_samples, 2)) - 0.5
        along = 0.5 + s.roadmap_graph_area_length_scale * drawn[:, :1]
        points = ends[0] + along * way + s.roadmap_graph_area_width * drawn[:, 1:] * across
    return np.vstack((ends[:1], points, ends[1:]))


def _edges(nodes: Floats, obstacles: ObstacleDistances, settings: TebSettings) -> Bools:
    """Return which nodes can be driven to from which, shape (n, n): forwards, off obstacles."""
    way = nodes[None, :] - nodes[:, None]
    length = np.hypot(*np.moveaxis(way, -1, 0))
    ahead = (nodes[-1] - nodes[0]) / math.dist(nodes[0], nodes[-1])
    edges: Bools = way @ ahead > settings.obstacle_heading_threshold * np.maximum(length, 1e-9)
    first, last = np.nonzero(edges)
    count = max(2, math.ceil(float(length[edges].max(initial=0.0)) / _SPACING) + 1)
    share = np.linspace(0.0, 1.0, count)[:, None]
    points = nodes[first][:, None] + share * way[first, last][:, None]
    edges[first, last] = (obstacles.at(points) >= settings.min_obstacle_dist).all(axis=1)
    return edges


def _shortest(nodes: Floats, edges: Bools, middles: Floats, most: int) -> list[tuple[int, ...]]:
    """Return the shortest path of each class from the first node to the last one."""
    angles = _angles(nodes[:, None] - middles)
    last = len(nodes) - 1
    paths: list[tuple[int, ...]] = []
    seen: set[tuple[int, PathClass]] = set()
    order = itertools.count()
    queue: list[tuple[float, int, tuple[int, ...], Floats]] = [
        (0.0, next(order), (0,), np.zeros(len(middles)))
    ]
    for _ in range(_MOST_STEPS):
        if not queue or len(paths) >= most:
            break
        length, _, path, turned = heapq.heappop(queue)
        here = path[-1]
        key = here, _whole_turns(turned, angles[here] - angles[0])
        if key in seen:
            continue
        seen.add(key)
        if here == last:
            paths.append(path)
            continue
        for there in np.flatnonzero(edges[here]).tolist():
            further = turned + wrapped_all(angles[there] - angles[here])
            apart = math.dist(nodes[here], nodes[there])
            heapq.heappush(queue, (length + apart, next(order), (*path, there), further))
    return paths


def _groups(obstacles: ObstacleDistances, near: Bools) -> list[Floats]:
    """Return the middles of cells that hang together, group by group."""
    cells = np.argwhere(near)
    labels = connected_cells(cells, near.shape)
    middles = np.array(obstacles.origin) + obstacles.resolution * (cells[:, ::-1] + 0.5)
    return [middles[labels == label] for label in np.unique(labels)]


def _nearest(points: Floats) -> int:
    """Return the index of the point nearest to the mean."""
    return int(np.hypot(*(points - points.mean(axis=0)).T).argmin())


def _angles(away: Floats) -> Floats:
    found: Floats = np.arctan2(away[..., 1], away[..., 0])
    return found


def _whole_turns(turned: Floats, between: Floats) -> PathClass:
    """Return by how many turns angles differ from those of the direct way."""
    turns = np.rint((turned - wrapped_all(between)) / (2.0 * math.pi))
    return tuple(turns.astype(int).tolist())
