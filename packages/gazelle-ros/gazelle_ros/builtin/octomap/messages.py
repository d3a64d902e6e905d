"""Messages of a map of occupied and free space."""

from __future__ import annotations

import colorsys

import numpy as np

from gazelle_ros.base.array_types import Floats
from gazelle_ros.builtin.octomap.morton import DEPTH
from gazelle_ros.msgs import geometry_msgs, nav_msgs, octomap_msgs, std_msgs, visualization_msgs

_MARKER = visualization_msgs.msg.Marker
_OCCUPIED = std_msgs.msg.ColorRGBA(r=0.0, g=0.0, b=1.0, a=1.0)
_FREE = std_msgs.msg.ColorRGBA(r=0.0, g=1.0, b=0.0, a=1.0)
_SHADES = 64
"""Colours of heights, from the lowest to the highest cell."""
_HUES = 0.8
"""Share of the colour circle from the lowest to the highest cell, as in the original."""


def octomap(
    header: std_msgs.msg.Header, resolution: float, data: bytes, *, binary: bool
) -> octomap_msgs.msg.Octomap:
    """Return a tree of a resolution [m] as a message."""
    return octomap_msgs.msg.Octomap(
        header=header,
        binary=binary,
        id="OcTree",
        resolution=resolution,
        data=np.frombuffer(data, np.int8).tolist(),
    )


def cubes(
    header: std_msgs.msg.Header,
    resolution: float,
    centers: Floats,
    *,
    by_height: bool = False,
    free: bool = False,
) -> visualization_msgs.msg.MarkerArray:
    """Return cells as cubes, a marker for each depth of the tree as in the original.

    Args:
        header: Of the map.
        resolution: Side of a cell [m].
        centers: Middles of the cells [m], shape (n, 3).
        by_height: Whether their colours are those of their heights.
        free: Whether they are free.
    """
    made = visualization_msgs.msg.MarkerArray()
    for depth in range(DEPTH + 1):
        side = resolution * 2 ** (DEPTH - depth)
        marker = _MARKER(header=header, ns="map", id=depth, type=_MARKER.CUBE_LIST)
        marker.action = _MARKER.DELETE
        marker.scale.x = marker.scale.y = marker.scale.z = side
        marker.color = _FREE if free else _OCCUPIED
        marker.pose.orientation.w = 1.0
        made.markers.append(marker)
    last = made.markers[DEPTH]
    if len(centers):
        last.action = _MARKER.ADD
        last.points = [geometry_msgs.msg.Point(*each) for each in centers.tolist()]
        if by_height:
            last.colors = _colors(centers[:, 2])
    return made


def projected(
    header: std_msgs.msg.Header,
    resolution: float,
    every: Floats,
    free: Floats,
    occupied: Floats,
    least: tuple[float, float],
) -> nav_msgs.msg.OccupancyGrid:
    """Return a map of the plane: occupied where any cell of a column is.

    Args:
        header: Of the map.
        resolution: Side of a cell [m].
        every: Middles of all known cells [m], shape (n, 3); the map reaches as far.
        free: Middles of those that make the plane free.
        occupied: Middles of those that make it occupied.
        least: Sizes along x and y that it has at least, around its origin [m].
    """
    made = nav_msgs.msg.OccupancyGrid(header=header)
    made.info.resolution, made.info.map_load_time = resolution, header.stamp
    made.info.origin.orientation.w = 1.0
    half = 0.5 * np.array(least)
    corners = np.concatenate((every[:, :2], [-half, half] if half.any() else np.zeros((0, 2))))
    if not len(corners):
        return made
    cells = np.floor(corners / resolution).astype(np.int64)
    low = cells.min(axis=0)
    columns, rows = (cells.max(axis=0) - low + 1).tolist()
    grid = np.full((rows, columns), -1, np.int8)
    for centers, value in ((free, 0), (occupied, 100)):
        x, y = (np.floor(centers[:, :2] / resolution).astype(np.int64) - low).T
        grid[y, x] = value
    made.info.width, made.info.height = columns, rows
    made.info.origin.position.x, made.info.origin.position.y = (low * resolution).tolist()
    made.data = grid.ravel().tolist()
    return made


def _colors(heights: Floats) -> list[std_msgs.msg.ColorRGBA]:
    """Return a colour for each height."""
    low, span = heights.min(), max(float(np.ptp(heights)), 1e-9)
    shades = [
        std_msgs.msg.ColorRGBA(
            *colorsys.hsv_to_rgb((1.0 - _HUES * shade / (_SHADES - 1)) % 1.0, 1.0, 1.0), 1.0
        )
        for shade in range(_SHADES)
    ]
    chosen = ((heights - low) * ((_SHADES - 1) / span)).astype(np.intp)
    return [shades[each] for each in chosen.tolist()]
