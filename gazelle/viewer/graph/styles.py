"""Colours and sizes of what displays draw."""

from __future__ import annotations

from dataclasses import dataclass

Color = tuple[int, int, int]


@dataclass
class DisplayStyle:
    """Colour and size of one display; None where its type has none to choose.

    Attributes:
        color: Red, green and blue, 0 to 255.
        size: In the unit of `SIZE_LABELS`.
    """

    color: Color | None = None
    size: float | None = None


SIZE_LABELS = {
    "geometry_msgs/PointStamped": "Radius [m]",
    "geometry_msgs/PolygonStamped": "Width [px]",
    "geometry_msgs/PoseArray": "Axes [m]",
    "geometry_msgs/PoseStamped": "Axes [m]",
    "geometry_msgs/PoseWithCovarianceStamped": "Axes [m]",
    "nav_msgs/Odometry": "Axes [m]",
    "nav_msgs/Path": "Width [px]",
    "sensor_msgs/LaserScan": "Points [m]",
    "sensor_msgs/PointCloud2": "Points [m]",
}
"""Labels of sizes, by type of message."""

_DEFAULTS: dict[str, tuple[Color | None, float | None]] = {
    "geometry_msgs/PointStamped": ((200, 60, 200), 0.08),
    "geometry_msgs/PolygonStamped": ((40, 160, 70), 3.0),
    "geometry_msgs/PoseArray": (None, 0.3),
    "geometry_msgs/PoseStamped": (None, 0.3),
    "geometry_msgs/PoseWithCovarianceStamped": (None, 0.3),
    "nav_msgs/Odometry": (None, 0.3),
    "nav_msgs/Path": ((40, 160, 70), 3.0),
    "sensor_msgs/LaserScan": ((210, 40, 40), 0.04),
    "sensor_msgs/PointCloud2": ((50, 110, 190), 0.02),
}


def default_style(kind: str) -> DisplayStyle:
    """Return the style that displays of a type of message begin with."""
    return DisplayStyle(*_DEFAULTS.get(kind, (None, None)))
