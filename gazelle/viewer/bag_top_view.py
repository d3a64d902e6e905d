"""Top view of a bag without images: map, scans, plans, and paths of robots."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image, ImageDraw

from gazelle.array_types import Bytes, Floats, Picture
from gazelle.bridges.navigation.map_messages import grid_of_message
from gazelle.description import OccupancyMap
from gazelle.errors import RosError
from gazelle.rotations import rotate, yaw_of
from gazelle.viewer.plan import PAPER, PlanFrame, colour_of
from gazelle.viewer.sources import IMAGES, BagSource, FilmSource
from gazelle_ros.bags import Bag
from gazelle_ros.tf.core import FrameTree
from gazelle_ros.tf.errors import TransformException
from gazelle_ros.tf.taking import take_transforms

_TRANSFORMS = ("tf2_msgs/TFMessage", "tf/tfMessage")
_SCAN, _MAP, _PATH = "sensor_msgs/LaserScan", "nav_msgs/OccupancyGrid", "nav_msgs/Path"
_ODOMETRY = "nav_msgs/Odometry"
_SHOWN = (_SCAN, _MAP, _PATH, _ODOMETRY)
_FIXED = ("map", "odom", "world")  # frames that pictures stand still in, the best first
_HIT, _PLAN = (206, 62, 52), (40, 140, 70)
_WALL, _UNKNOWN = (60, 60, 66), (222, 222, 220)
_RADIUS = 0.15  # of a robot [m]
_MARGIN = 0.5  # around all that is known [m]
_FOR_EVER = 10**18  # [ns]


@dataclass(frozen=True, slots=True)
class FramePlace:
    """Pose of a frame: position (3,) [m] and rotation x, y, z, w (4,)."""

    position: Floats
    quaternion: Floats

    def of(self, points: Floats) -> Floats:
        """Return points of the frame, shape (n, 3), in the fixed frame."""
        moved: Floats = rotate(np.tile(self.quaternion, (len(points), 1)), points) + self.position
        return moved


@dataclass(slots=True)
class _Shown:
    """Content that is drawn now."""

    grid: OccupancyMap | None = None
    scans: dict[str, Floats] = field(default_factory=dict)
    plans: dict[str, Floats] = field(default_factory=dict)
    trajectories: dict[str, list[Floats]] = field(default_factory=dict)


class BagTopView(FilmSource):
    """A bag from above.

    Args:
        path: The bag.
        size: Width and height of pictures [pixel].

    Raises:
        RosError: It has no scans, maps, plans or odometry.
    """

    def __init__(self, path: Path, size: tuple[int, int] = (960, 720)) -> None:
        self._bag, self._size = Bag(str(path)), size
        try:
            topics = self._bag.get_type_and_topic_info().topics
            self._kinds = _kinds(topics, path)
            self._tree = FrameTree(_FOR_EVER)
            self._fixed = self._read_frames(
                [n for n, t in topics.items() if t.msg_type in _TRANSFORMS]
            )
            self._frame = PlanFrame(self._extent(), size)
            self._shown = _Shown()
            self._map: tuple[OccupancyMap, Bytes] | None = None
            self._messages = self._bag.read_messages(topics=list(self._kinds))
            self._next: Any = next(self._messages, None)
            self._start = 0 if self._next is None else self._next.timestamp.to_nsec()
        except BaseException:
            self._bag.close()
            raise
        self.advance(0.0)

    def advance(self, seconds: float) -> bool:
        """Advance to a time after the first message [s]."""
        end = self._start + round(seconds * 1e9)
        while self._next is not None and self._next.timestamp.to_nsec() <= end:
            self._take(self._shown, self._next)
            self._next = next(self._messages, None)
        return self._next is not None

    def render(self) -> Picture:
        """Render the map, then paths, plans, scans and robots."""
        canvas = Image.fromarray(self._paper())
        draw = ImageDraw.Draw(canvas)
        for number, trajectory in enumerate(self._shown.trajectories.values()):
            points = np.array(trajectory)
            if len(points) > 1:
                draw.line(self._frame.path(points[:, :2]), fill=colour_of(number), width=3)
        for plan in self._shown.plans.values():
            if len(plan) > 1:
                draw.line(self._frame.path(plan[:, :2]), fill=_PLAN, width=4)
        for scan in self._shown.scans.values():
            for x, y in self._frame.path(scan[:, :2]):
                draw.rectangle((x - 2, y - 2, x + 2, y + 2), fill=_HIT)
        for number, trajectory in enumerate(self._shown.trajectories.values()):
            self._draw_robot(draw, trajectory[-1], colour_of(number))
        return np.asarray(canvas.resize(self._size, Image.Resampling.BOX), np.uint8)

    def close(self) -> None:
        """Close the bag."""
        self._bag.close()

    # Reading --------------------------------------------------------------------------------

    def _read_frames(self, topics: list[str]) -> str:
        """Read all transforms of the bag; returns the fixed frame of pictures."""
        frames: set[str] = set()
        for entry in self._bag.read_messages(topics=topics) if topics else ():
            static = entry.topic.endswith("tf_static")
            take_transforms(self._tree, entry.message, authority="bag", static=static)
            for each in entry.message.transforms:
                frames |= {each.header.frame_id.lstrip("/"), each.child_frame_id.lstrip("/")}
        for entry in self._bag.read_messages(topics=list(self._kinds)):
            frames.add(entry.message.header.frame_id.lstrip("/"))
        return next((name for name in _FIXED if name in frames), min(frames, default=""))

    def _extent(self) -> tuple[float, float, float, float]:
        """Return the extent of all that will be shown, with a margin."""
        low, high = np.full(2, np.inf), np.full(2, -np.inf)
        for points in self._everywhere():
            if len(points):
                low, high = np.minimum(low, points.min(0)), np.maximum(high, points.max(0))
        if not np.isfinite(low).all():
            low, high = np.full(2, -2.0), np.full(2, 2.0)
        low, high = low - _MARGIN, high + _MARGIN
        return (float(low[0]), float(low[1]), float(high[0]), float(high[1]))

    def _everywhere(self) -> Iterator[Floats]:
        shown = _Shown()
        for entry in self._bag.read_messages(topics=list(self._kinds)):
            self._take(shown, entry)
            for parts in (shown.scans, shown.plans):
                yield from (part[:, :2] for part in parts.values())
            yield from (
                np.array(trajectory[-1:])[:, :2] for trajectory in shown.trajectories.values()
            )
            if shown.grid is not None and self._kinds[entry.topic] == _MAP:
                rows, columns = shown.grid.data.shape
                side = shown.grid.resolution
                corners = np.array([[0, 0, 0], [columns, 0, 0], [0, rows, 0], [columns, rows, 0]])
                origin = shown.grid.origin
                place = FramePlace(np.array(origin.position), np.array(origin.quaternion))
                yield place.of(corners * side)[:, :2]

    def _take(self, shown: _Shown, entry: Any) -> None:
        """Store the content of a message."""
        message, kind = entry.message, self._kinds[entry.topic]
        if kind == _MAP:
            shown.grid = grid_of_message(message)
            return
        header = message.header
        place = self._place(header.frame_id.lstrip("/"), header.stamp.to_nsec())
        if kind == _SCAN:
            place = place or _last_place(shown)
            if place is not None:
                shown.scans[entry.topic] = place.of(_ends(message))
                if _ODOMETRY not in self._kinds.values():
                    shown.trajectories.setdefault(entry.topic, []).append(_pose(place))
        elif place is not None and kind == _PATH:
            spots = [(p.pose.position.x, p.pose.position.y, 0.0) for p in message.poses]
            shown.plans[entry.topic] = place.of(np.array(spots, np.float64).reshape(-1, 3))
        elif place is not None:
            at, rotation = message.pose.pose.position, message.pose.pose.orientation
            there = place.of(np.array([[at.x, at.y, at.z]]))[0]
            heading = yaw_of(np.array([[rotation.x, rotation.y, rotation.z, rotation.w]]))[0]
            turn = heading + yaw_of(place.quaternion[None])[0]
            shown.trajectories.setdefault(entry.topic, []).append(
                np.array([there[0], there[1], turn])
            )

    def _place(self, frame: str, stamp: int) -> FramePlace | None:
        """Return the pose of a frame in the fixed one, at that time or the latest; None if unknown."""
        if frame == self._fixed:
            return FramePlace(np.zeros(3), np.array([0.0, 0.0, 0.0, 1.0]))
        for when in (stamp, 0):
            try:
                found = self._tree.lookup(self._fixed, frame, when)
            except TransformException:
                continue
            return FramePlace(np.array(found.translation), np.array(found.rotation))
        return None

    # Drawing --------------------------------------------------------------------------------

    def _paper(self) -> Bytes:
        """Return the map in its colours, or white, for the large picture."""
        grid = self._shown.grid
        if grid is None:
            return np.tile(np.array(PAPER, np.uint8), (*self._frame.shape, 1))
        if self._map is None or self._map[0] is not grid:
            self._map = grid, _painted(grid, self._frame.middles())
        return self._map[1]

    def _draw_robot(
        self, draw: ImageDraw.ImageDraw, pose: Floats, colour: tuple[int, int, int]
    ) -> None:
        x, y, heading = pose.tolist()
        draw.ellipse(self._frame.box(x, y, _RADIUS), fill=colour)
        ahead = [[x, y], [x + _RADIUS * np.cos(heading), y + _RADIUS * np.sin(heading)]]
        draw.line(self._frame.path(ahead), fill=PAPER, width=4)


def _kinds(topics: Mapping[str, Any], path: Path) -> dict[str, str]:
    """Return the topics that are shown, with their types.

    Raises:
        RosError: There are none.
    """
    found = {name: info.msg_type for name, info in topics.items() if info.msg_type in _SHOWN}
    if not found:
        raise RosError(
            f"'{path.name}' has nothing that can be seen",
            hint="pictures, scans, maps, plans or odometry are shown",
        )
    return found


def _painted(grid: OccupancyMap, places: Floats) -> Bytes:
    """Return the colours of a map at places, shape (height, width, 2) [m]."""
    origin = grid.origin
    away = places - np.array(origin.position[:2])
    cos, sin = np.cos(origin.yaw), np.sin(origin.yaw)
    column = np.floor((away[..., 0] * cos + away[..., 1] * sin) / grid.resolution).astype(int)
    row = np.floor((away[..., 1] * cos - away[..., 0] * sin) / grid.resolution).astype(int)
    rows, columns = grid.data.shape
    inside = (row >= 0) & (row < rows) & (column >= 0) & (column < columns)
    cells = np.where(inside, grid.data[row.clip(0, rows - 1), column.clip(0, columns - 1)], -2)
    made = np.tile(np.array(PAPER, np.uint8), (*cells.shape, 1))
    made[cells == -1] = _UNKNOWN
    made[cells > 50] = _WALL
    return made


def _ends(message: Any) -> Floats:
    """Return the ends of a scan's beams, in its frame, shape (n, 3) [m]."""
    ranges = np.asarray(message.ranges, np.float64)
    angles = message.angle_min + message.angle_increment * np.arange(len(ranges))
    good = np.isfinite(ranges) & (ranges >= message.range_min) & (ranges < message.range_max)
    points = np.zeros((int(good.sum()), 3))
    points[:, 0] = ranges[good] * np.cos(angles[good])
    points[:, 1] = ranges[good] * np.sin(angles[good])
    return points


def _pose(place: FramePlace) -> Floats:
    return np.array([*place.position[:2], yaw_of(place.quaternion[None])[0]])


def _last_place(shown: _Shown) -> FramePlace | None:
    """Return the robot's pose by odometry, for scans whose frame has no transform."""
    for trajectory in shown.trajectories.values():
        x, y, heading = trajectory[-1].tolist()
        turn = np.array([0.0, 0.0, np.sin(heading / 2.0), np.cos(heading / 2.0)])
        return FramePlace(np.array([x, y, 0.0]), turn)
    return None


def bag_source(
    path: Path, topic: str | None = None, *, top: bool = False, size: tuple[int, int] = (960, 720)
) -> FilmSource:
    """Return the pictures of a bag; where it has none, or on request, the bag from above.

    Args:
        path: The bag.
        topic: Of pictures; the first if None.
        top: Show it from above though it has pictures.
        size: Of pictures from above, width and height [pixel].

    Raises:
        RosError: There is no such topic, or nothing to be seen at all.
    """
    if not top:
        with Bag(str(path)) as bag:
            kinds = {about.msg_type for about in bag.get_type_and_topic_info().topics.values()}
        if topic is not None or kinds & set(IMAGES):
            return BagSource(path, topic)
    return BagTopView(path, size)
