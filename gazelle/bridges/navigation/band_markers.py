"""Bands, obstacles and the robot's shape as markers, by the names of ``teb_local_planner``."""

from __future__ import annotations

import itertools
from collections.abc import Iterable

import numpy as np

from gazelle.array_types import Floats
from gazelle.bridges.navigation.messages import fill_pose
from gazelle.navigation.costmap.values import LETHAL
from gazelle.navigation.planners.planar import moved
from gazelle.navigation.planners.teb import TebPlanner
from gazelle.navigation.planners.teb_cost import Band
from gazelle_ros.msgs import geometry_msgs, std_msgs, visualization_msgs
from gazelle_ros.time import Duration

Marker = visualization_msgs.msg.Marker
_SHOWN_S = 2.0
_RED, _GREEN, _BLUE = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
_LIME, _GREY = (0.5, 1.0, 0.0), (0.5, 0.5, 0.5)
_THIN, _DOT = 0.01, 0.1


def band_markers(planner: TebPlanner, header: std_msgs.msg.Header) -> list[Marker]:
    """Return the markers of a planner's last cycle.

    Args:
        planner: The planner.
        header: Of the markers, in the frame of the local costmap.
    """
    bands = planner.search.bands
    found = [
        _marker(header, "TebContainer", Marker.LINE_LIST, _THIN, _LIME, _segments(bands)),
        _marker(header, "PointObstacles", Marker.POINTS, planner.costmap.resolution, _RED, _points(planner)),
        *_shapes(planner, header),
    ]  # fmt: skip
    if len(planner.vias):
        found.append(_marker(header, "ViaPoints", Marker.POINTS, _DOT, _BLUE, planner.vias))
    return found + (_robot(planner, bands[0], header) if bands else [])


def _marker(
    header: std_msgs.msg.Header,
    space: str,
    kind: int,
    size: float,
    colour: tuple[float, float, float],
    points: Iterable[Iterable[float]],
    number: int = 0,
) -> Marker:
    made = Marker(header=header, ns=space, id=number, type=kind, action=Marker.ADD)
    made.pose.orientation.w = 1.0
    made.lifetime = Duration(_SHOWN_S)
    made.scale.x = made.scale.y = size
    made.color.r, made.color.g, made.color.b = colour
    made.color.a = 1.0
    made.points = [geometry_msgs.msg.Point(x=float(x), y=float(y)) for x, y in points]
    return made


def _segments(bands: list[Band]) -> Iterable[Floats]:
    for band in bands:
        for pair in itertools.pairwise(band.poses[:, :2]):
            yield from pair


def _points(planner: TebPlanner) -> Floats:
    """Return lethal cells of the costmap, and obstacles that are points, shape (n, 2) [m]."""
    costmap = planner.costmap
    found: Floats = np.zeros((0, 2))
    if planner.settings.include_costmap_obstacles:
        cells = np.argwhere(costmap.cells == LETHAL)[:, ::-1]
        found = np.array(costmap.origin[:2]) + costmap.resolution * (cells + 0.5)
    single = [
        each.corners for each in planner.obstacles if len(each.corners) == 1 and not each.radius
    ]
    return np.concatenate((found, *single))


def _shapes(planner: TebPlanner, header: std_msgs.msg.Header) -> list[Marker]:
    """Return circles, lines and polygons of ``obstacles``."""
    found = []
    for number, each in enumerate(planner.obstacles):
        corners = each.corners
        if each.radius:
            space, kind, size, colour = "CircularObstacles", Marker.SPHERE_LIST, each.radius, _GREEN
        elif len(corners) == 2:
            space, kind, size, colour = "LineObstacles", Marker.LINE_STRIP, _DOT, _GREEN
        elif len(corners) > 2:
            space, kind, size, colour = "PolyObstacles", Marker.LINE_STRIP, _DOT, _RED
            corners = np.vstack((corners, corners[:1]))
        else:
            continue
        found.append(_marker(header, space, kind, size, colour, corners, number))
    return found


def _robot(planner: TebPlanner, band: Band, header: std_msgs.msg.Header) -> list[Marker]:
    """Return the robot's shape where the band begins: circles, or a line through its points."""
    x, y, yaw = band.poses[0].tolist()
    space, shape = "RobotFootprintModel", planner.footprint
    if not shape.radii.any():
        if len(shape.centers) == 1:
            return []
        points = moved(shape.centers, (x, y, yaw))
        return [_marker(header, space, Marker.LINE_STRIP, _THIN, _GREY, points)]
    found = []
    for number, (center, radius) in enumerate(zip(shape.centers, shape.radii, strict=True)):
        place = moved(center[None], (x, y, yaw))[0]
        made = _marker(header, space, Marker.CYLINDER, 2.0 * float(radius), _GREY, (), number)
        fill_pose(made.pose, (float(place[0]), float(place[1]), yaw))
        made.scale.z = 0.05
        found.append(made)
    return found
