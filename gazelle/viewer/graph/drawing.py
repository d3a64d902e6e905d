"""Drawing of messages of each type on a page."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from gazelle.array_types import Bytes, Floats
from gazelle.rotations import rotate
from gazelle.viewer.graph.styles import Color, DisplayStyle
from gazelle.viewer.page.shapes import textured_mesh
from gazelle_ros.errors import RosError
from gazelle_ros.msgs import geometry_msgs, nav_msgs, sensor_msgs

if TYPE_CHECKING:
    from viser import ViserServer

_MOST = 100_000  # points of a cloud
_GREY = (128, 128, 128)
_NUMBERS = {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 8: "f8"}
"""Of ``PointField.datatype``."""
_IDENTITY = np.array([1.0, 0.0, 0.0, 0.0])


class Drawing:
    """Parts of one topic on the page, under the frame of its messages.

    Args:
        page: viser's server.
        name: Of the node that it hangs on.
        topic: Its name.
        style: Colours and sizes.

    Attributes:
        extents: Lowest and highest corner [m] of the parts that have one, in the frame of the
            messages, shape (2, 3).
    """

    def __init__(self, page: ViserServer, name: str, topic: str, style: DisplayStyle) -> None:
        self.page, self.name, self.topic, self.style = page, name, topic, style
        self.extents: dict[str, Floats] = {}
        self._parts: dict[str, Any] = {}

    @property
    def color(self) -> Color:
        """Colour of the display."""
        return self.style.color or _GREY

    @property
    def size(self) -> float:
        """Size of the display, above zero."""
        return max(self.style.size or 0.0, 1e-3)

    def span(self, key: str, points: Floats) -> None:
        """Note how far a part reaches, by points [m], shape (n, 3)."""
        if len(points):
            self.extents[key] = np.array([points.min(axis=0), points.max(axis=0)])
        else:
            self.extents.pop(key, None)

    def put(self, key: str, make: Callable[[str], Any]) -> Any:
        """Replace a part under its key."""
        self.drop(key)
        self._parts[key] = made = make(f"{self.name}/{key}")
        return made

    @property
    def parts(self) -> list[Any]:
        """All parts that are there."""
        return list(self._parts.values())

    def part(self, key: str) -> Any:
        """Return a part that is there, or None."""
        return self._parts.get(key)

    def drop(self, key: str) -> None:
        """Remove a part."""
        self.extents.pop(key, None)
        if key in self._parts:
            self._parts.pop(key).remove()

    def clear(self) -> None:
        """Remove everything."""
        for key in tuple(self._parts):
            self.drop(key)


def draw_scan(drawing: Drawing, message: sensor_msgs.msg.LaserScan) -> None:
    """Draw points of a LaserScan."""
    ranges = np.asarray(message.ranges, np.float64)
    angles = message.angle_min + message.angle_increment * np.arange(len(ranges))
    seen = np.isfinite(ranges) & (ranges >= message.range_min) & (ranges <= message.range_max)
    points = np.zeros((int(seen.sum()), 3))
    points[:, 0] = ranges[seen] * np.cos(angles[seen])
    points[:, 1] = ranges[seen] * np.sin(angles[seen])
    _points(drawing, points, np.array(drawing.color, np.uint8))


def draw_cloud(drawing: Drawing, message: sensor_msgs.msg.PointCloud2) -> None:
    """Draw points of a PointCloud2, in their colours or by their intensities if they have any."""
    points, colors = points_of(message, drawing.color)
    finite = np.isfinite(points).all(axis=1)
    every = max(1, -(-int(finite.sum()) // _MOST))
    shown = colors if colors.ndim == 1 else colors[finite][::every]
    _points(drawing, points[finite][::every], shown)


def points_of(message: sensor_msgs.msg.PointCloud2, plain: Color = _GREY) -> tuple[Floats, Bytes]:
    """Return points of a PointCloud2 [m], shape (n, 3), and colours, shape (n, 3) or (3,).

    Args:
        message: The cloud.
        plain: Colour of a cloud without colours and intensities.

    Raises:
        RosError: It has fewer bytes than its points need.
    """
    needed = (message.height - 1) * message.row_step + message.width * message.point_step
    if len(message.data) < needed:
        raise RosError(
            f"a cloud of {message.width} x {message.height} points needs {needed} bytes, "
            f"not {len(message.data)}"
        )
    count = message.width * message.height
    raw = np.frombuffer(bytes(message.data), np.uint8)
    rows = np.lib.stride_tricks.as_strided(
        raw,
        (message.height, message.width, message.point_step),
        (message.row_step, message.point_step, 1),
        writeable=False,
    ).reshape(count, message.point_step)
    order = ">" if message.is_bigendian else "<"
    fields = {field.name: field for field in message.fields}
    points = np.full((count, 3), np.nan)
    for column, name in enumerate("xyz"):
        if name in fields:
            points[:, column] = _column(rows, fields[name], order)
    color = fields.get("rgb") or fields.get("rgba")
    if color is None and "intensity" in fields:
        return points, rainbow(_column(rows, fields["intensity"], order))
    if color is None:
        return points, np.array(plain, np.uint8)
    part = rows[:, color.offset : color.offset + 3]
    return points, np.ascontiguousarray(part[:, ::-1] if order == "<" else part)


def _column(rows: Bytes, field: sensor_msgs.msg.PointField, order: str) -> Floats:
    """Return the numbers of one field of a PointCloud2, shape (n,)."""
    kind = np.dtype(order + _NUMBERS[field.datatype])
    part = np.ascontiguousarray(rows[:, field.offset : field.offset + kind.itemsize])
    return np.asarray(part.view(kind)[:, 0], np.float64)


def rainbow(values: Floats) -> Bytes:
    """Return colours from blue for the least value over green to red for the most, shape (n, 3).

    What is not a number is blue; so is all where all values are alike.
    """
    known = values[np.isfinite(values)]
    low, high = (float(known.min()), float(known.max())) if len(known) else (0.0, 0.0)
    span = high - low
    share = np.where(np.isfinite(values), values - low, 0.0) / (span if span > 0.0 else 1.0)
    hue = 4.0 * np.clip(1.0 - share, 0.0, 1.0)[:, None]  # red 0, green 2, blue 4, as in HSV
    away = np.abs(hue - np.array([0.0, 2.0, 4.0]))
    return np.asarray(255.0 * np.clip(2.0 - away, 0.0, 1.0) + 0.5, np.uint8)


def draw_map(drawing: Drawing, message: nav_msgs.msg.OccupancyGrid) -> None:
    """Draw an OccupancyGrid on the ground: free is white, occupied black, unknown grey."""
    info = message.info
    if not (info.width and info.height):
        return
    cells = np.asarray(message.data, np.int8).reshape(info.height, info.width).astype(np.int16)
    tones = np.where(cells < 0, 160, 255 - np.clip(cells, 0, 100) * 255 // 100)
    picture = np.repeat(np.asarray(tones, np.uint8)[::-1, :, None], 3, axis=2)
    wide, high = info.width * info.resolution, info.height * info.resolution
    corners = np.array([[0, 0, 0], [wide, 0, 0], [wide, high, 0], [0, high, 0]], np.float64)
    uv = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], np.float64)
    mesh = textured_mesh(corners, np.array([[0, 1, 2], [0, 2, 3]]), uv, picture)
    place, turn = pose_of(info.origin)
    place[2] -= 0.005  # below what lies on it
    drawing.put(
        "map",
        lambda name: drawing.page.scene.add_mesh_trimesh(name, mesh, wxyz=turn, position=place),
    )
    x, y, z, w = *turn[1:], turn[0]
    drawing.span("map", place + rotate(np.array([[x, y, z, w]]), corners))


def draw_path(drawing: Drawing, message: nav_msgs.msg.Path) -> None:
    """Draw a Path as a line."""
    points = np.array([pose_of(each.pose)[0] for each in message.poses]).reshape(-1, 3)
    _lines(drawing, "path", points)


def draw_polygon(drawing: Drawing, message: geometry_msgs.msg.PolygonStamped) -> None:
    """Draw the outline of a PolygonStamped, such as a footprint."""
    points = np.array([[p.x, p.y, p.z] for p in message.polygon.points]).reshape(-1, 3)
    _lines(drawing, "polygon", np.vstack((points, points[:1])))


def draw_point(drawing: Drawing, message: geometry_msgs.msg.PointStamped) -> None:
    """Draw a ball at a PointStamped."""
    at = np.array([message.point.x, message.point.y, message.point.z])
    drawing.put("point", lambda name: drawing.page.scene.add_icosphere(
        name, drawing.size, drawing.color, position=at, cast_shadow=False
    ))  # fmt: skip
    drawing.span("point", at[None])


def draw_pose(
    drawing: Drawing,
    message: geometry_msgs.msg.PoseStamped
    | geometry_msgs.msg.PoseWithCovarianceStamped
    | nav_msgs.msg.Odometry,
) -> None:
    """Draw axes of a PoseStamped, a PoseWithCovarianceStamped or an Odometry."""
    pose = message.pose
    _axes(drawing, [pose.pose if hasattr(pose, "pose") else pose])


def draw_poses(drawing: Drawing, message: geometry_msgs.msg.PoseArray) -> None:
    """Draw axes of a PoseArray."""
    _axes(drawing, message.poses)


def _points(drawing: Drawing, points: Floats, colors: Bytes) -> None:
    shown = drawing.part("points")
    if shown is not None and colors.ndim == 1:
        shown.points = points.astype(np.float32)
        shown.colors = colors
        shown.point_size = drawing.size
    else:
        drawing.put(
            "points",
            lambda name: drawing.page.scene.add_point_cloud(
                name, points, colors, point_size=drawing.size, point_shape="circle",
                precision="float32",
            ),
        )  # fmt: skip
    drawing.span("points", points)


def _lines(drawing: Drawing, key: str, points: Floats) -> None:
    """Draw lines from each point to the next."""
    drawing.drop(key)
    if len(points) > 1:
        lines = np.stack((points[:-1], points[1:]), axis=1).astype(np.float32)
        drawing.put(
            key,
            lambda name: drawing.page.scene.add_line_segments(
                name, lines, drawing.color, thickness=drawing.size, thickness_units="screen"
            ),
        )
    drawing.span(key, points)


def _axes(drawing: Drawing, poses: list[geometry_msgs.msg.Pose]) -> None:
    found = [pose_of(pose) for pose in poses]
    if not found:
        drawing.drop("axes")
        return
    at, turned = np.array([each[0] for each in found]), np.array([each[1] for each in found])
    shown = drawing.part("axes")
    if shown is not None and len(shown.batched_positions) == len(at):
        shown.batched_positions = at.astype(np.float32)
        shown.batched_wxyzs = turned.astype(np.float32)
        shown.axes_length, shown.axes_radius = drawing.size, 0.04 * drawing.size
    else:
        drawing.put(
            "axes",
            lambda name: drawing.page.scene.add_batched_axes(
                name, turned, at, axes_length=drawing.size, axes_radius=0.04 * drawing.size
            ),
        )
    drawing.span("axes", at)


def pose_of(pose: geometry_msgs.msg.Pose) -> tuple[Floats, Floats]:
    """Return position and quaternion (w, x, y, z) of a Pose message; identity without one."""
    at, turned = pose.position, pose.orientation
    q = np.array([turned.w, turned.x, turned.y, turned.z])
    length = float(np.linalg.norm(q))
    return np.array([at.x, at.y, at.z]), (q / length if length > 1e-6 else _IDENTITY)


KINDS: dict[str, Callable[[Drawing, Any], None]] = {
    "geometry_msgs/PointStamped": draw_point,
    "geometry_msgs/PolygonStamped": draw_polygon,
    "geometry_msgs/PoseArray": draw_poses,
    "geometry_msgs/PoseStamped": draw_pose,
    "geometry_msgs/PoseWithCovarianceStamped": draw_pose,
    "nav_msgs/OccupancyGrid": draw_map,
    "nav_msgs/Odometry": draw_pose,
    "nav_msgs/Path": draw_path,
    "sensor_msgs/LaserScan": draw_scan,
    "sensor_msgs/PointCloud2": draw_cloud,
}
"""Functions that draw messages, by type."""
