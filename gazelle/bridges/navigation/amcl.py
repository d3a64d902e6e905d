"""The node ``amcl``: where a robot is on a map (http://wiki.ros.org/amcl)."""

from __future__ import annotations

import dataclasses
import math
import threading
import warnings
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from gazelle.array_types import Floats
from gazelle.bridges.navigation.diagnosis import NavigationWarning, StartDiagnosis
from gazelle.bridges.navigation.frames import GraphFrames, flat, missing_links
from gazelle.bridges.navigation.map_messages import grid_of_message
from gazelle.bridges.navigation.maps import MapListener, map_of_service
from gazelle.bridges.navigation.messages import fill_pose, is_upside_down, pose_of
from gazelle.description.occupancy import OccupancyMap
from gazelle.errors import Error
from gazelle.navigation.following import Pose2
from gazelle.navigation.localization import AmclSettings, Localizer, PlanarScan
from gazelle.navigation.localization.odometry_models import MODELS
from gazelle.navigation.localization.settings import LASER_MODELS
from gazelle.navigation.planners.planar import between, composed
from gazelle.simulation import Tunable
from gazelle_ros.base.parameter_values import value_of, warn_of_unknown
from gazelle_ros.base.real_numbers import finite
from gazelle_ros.builtin.arguments import run_node
from gazelle_ros.builtin.parameters import private_values
from gazelle_ros.builtin.scans.points import beam_angles
from gazelle_ros.clock import SECOND
from gazelle_ros.msgs import geometry_msgs, nav_msgs, sensor_msgs, std_srvs
from gazelle_ros.node import Node
from gazelle_ros.reconfigure import ReconfigureServer
from gazelle_ros.tf import StampedTransform
from gazelle_ros.tf.scan_queue import ScanQueue
from gazelle_ros.time import Time

_LOOK_S = 0.2
_OTHERS = (
    "odom_frame_id", "base_frame_id", "global_frame_id", "transform_tolerance", "tf_broadcast",
    "use_map_topic", "first_map_only", "save_pose_rate", "tf_prefix", "initial_pose_x", "initial_pose_y",
    "initial_pose_a", "initial_cov_xx", "initial_cov_yy", "initial_cov_aa",
    "force_update_after_initialpose", "force_update_after_set_map", "beam_skip_error_threshold_",
)  # fmt: skip
"""Parameters that are not part of `AmclSettings`."""
_UNUSED = (
    "gui_publish_rate", "bag_scan_period", "std_warn_level_x", "std_warn_level_y", "std_warn_level_yaw",
    "restore_defaults",
)  # fmt: skip
"""Parameters of the original that change nothing here."""


def main(arguments: Sequence[str]) -> int:
    """Localise until shutdown; returns the exit code."""
    return run_node(arguments, "amcl", AmclNode)


class AmclNode:
    """A `Localizer` on a graph.

    Args:
        node: On the graph; parameters are those of ``amcl``.

    Raises:
        Error: A parameter is wrong.
    """

    def __init__(self, node: Node) -> None:
        self._node = node
        self._values = private_values(node)
        self.settings = AmclSettings.read(self._values)
        own = [each.name for each in dataclasses.fields(AmclSettings)]
        warn_of_unknown(node.resolve("~"), self._values, [*own, *_OTHERS, *_UNUSED])
        self._odom = value_of(self._values, "odom_frame_id", "odom").strip("/")
        self._base = value_of(self._values, "base_frame_id", "base_link").strip("/")
        self._whole = value_of(self._values, "global_frame_id", "map").strip("/")
        self._tolerance_ns = round(value_of(self._values, "transform_tolerance", 0.1) * SECOND)
        self._broadcast = value_of(self._values, "tf_broadcast", True)
        self._lock = threading.RLock()
        self._changed = threading.Condition(self._lock)
        self._localizer: Localizer | None = None
        self._pending: Callable[[Localizer], None] | None = None
        self._maps: MapListener | None = None
        if value_of(self._values, "use_map_topic", False):
            once = value_of(self._values, "first_map_only", False)
            self._maps = MapListener(node, "map", once=once)
        self._saved_at = 0
        self.frames = GraphFrames(node)
        self._scans = ScanQueue(node, "scan", sensor_msgs.msg.LaserScan)
        self.frames.tree.on_change(self._scans.wake)
        covariant = geometry_msgs.msg.PoseWithCovarianceStamped
        self._poses = node.advertise("amcl_pose", covariant, queue_size=2, latch=True)
        self._clouds = node.advertise(
            "particlecloud", geometry_msgs.msg.PoseArray, queue_size=2, latch=True
        )
        node.subscribe("initialpose", covariant, self._begin)
        empty = std_srvs.srv.Empty
        node.serve("global_localization", empty, self._begin_anywhere)
        node.serve("request_nomotion_update", empty, self._force)
        node.serve("set_map", nav_msgs.srv.SetMap, self._set_map)
        self._tuning = ReconfigureServer(node, node.name, _Tuning(self))
        self._diagnosis = StartDiagnosis(node, self._missing)

    # The life of it -----------------------------------------------------------------------

    def run(self, stop: threading.Event) -> None:
        """Receive a map, then process scans until shutdown."""
        if self._maps is None:
            grid = map_of_service(self._node, stop.is_set)
            if grid is not None:
                self._take_map(grid)
        while not stop.is_set() and not self._node.closed:
            fresh = self._maps.take() if self._maps is not None else None
            if fresh is not None:
                self._take_map(fresh)
            self._scans.work(self._find, self._use)
            localizer = self._localizer
            lost = localizer is None or localizer.map_to_odom is None
            self._diagnosis.check(waiting=lost)
        self._save()

    def _missing(self) -> list[str]:
        found = missing_links(self.frames.tree, "", self._odom, self._base, self._scans.frame)
        if not self._scans.seen:
            topic = self._node.resolve("scan")
            found.append(f"scans on {topic} (a laser sends them)")
        if self._localizer is None:
            found.append("a map (map_server serves it)")
        return found

    def _take_map(self, grid: OccupancyMap) -> None:
        with self._lock:
            localizer = Localizer(self.settings, grid)
            localizer.begin(*self._initial())
            pending, self._pending = self._pending, None
            if pending is not None:
                pending(localizer)
            self._localizer = localizer
            self._changed.notify_all()

    def _do(self, change: Callable[[Localizer], None]) -> None:
        """Change the filter now, or (only the last change) when there is a map."""
        with self._lock:
            if self._localizer is None:
                self._pending = change
            else:
                change(self._localizer)

    def _initial(self) -> tuple[Pose2, Floats]:
        """Return the initial pose and covariance given by parameters."""
        node = self._node

        def number(name: str, default: float) -> float:
            value = node.get_param(f"~{name}", default)
            number = finite(value)
            return default if number is None else number

        pose = tuple(number(f"initial_pose_{axis}", 0.0) for axis in "xya")
        spread = [
            number("initial_cov_xx", 0.25),
            number("initial_cov_yy", 0.25),
            number("initial_cov_aa", (math.pi / 12.0) ** 2),
        ]
        return (pose[0], pose[1], pose[2]), np.diag(spread)

    def apply(self, settings: AmclSettings) -> None:
        """Apply new settings while running."""
        with self._lock:
            self.settings = settings
            if self._localizer is not None:
                self._localizer.configure(settings)

    # Topics and services ------------------------------------------------------------------

    def _begin(self, message: geometry_msgs.msg.PoseWithCovarianceStamped) -> None:
        """Set an initial pose, advanced by the odometry since its time."""
        frame = message.header.frame_id.strip("/")
        if frame not in {"", self._whole}:
            warnings.warn(
                NavigationWarning(
                    f"{self._node.name} ignores an initial pose in '{frame}': give it in '{self._whole}' "
                    f"(in RViz the fixed frame)"
                ),
                stacklevel=2,
            )
            return
        pose = pose_of(message.pose.pose)
        stamp = message.header.stamp.to_nsec() or self.frames.latest(self._odom, self._base)
        cov = np.array(message.pose.covariance, np.float64).reshape(6, 6)[
            np.ix_([0, 1, 5], [0, 1, 5])
        ]

        def begin(localizer: Localizer) -> None:
            then = self.frames.pose(self._odom, self._base, stamp)
            now = self.frames.pose(self._odom, self._base)
            moved = between(then, now) if then is not None and now is not None else (0.0, 0.0, 0.0)
            localizer.begin(composed(pose, moved), cov)
            if value_of(self._values, "force_update_after_initialpose", False):
                localizer.force_update()

        self._do(begin)

    def _begin_anywhere(self, request: std_srvs.srv.EmptyRequest) -> list[Any]:
        """Start global localisation.

        The answer says that this has begun, so it waits for a map that a service is to give. One of
        a topic may never come.
        """
        del request
        self._do(Localizer.begin_anywhere)
        with self._changed:
            while self._localizer is None and self._maps is None and not self._node.closed:
                self._changed.wait(_LOOK_S)
        return []

    def _force(self, request: std_srvs.srv.EmptyRequest) -> list[Any]:
        del request
        with self._lock:
            if self._localizer is not None:
                self._localizer.force_update()
        return []

    def _set_map(self, request: nav_msgs.srv.SetMapRequest) -> list[Any]:
        self._take_map(grid_of_message(request.map))
        self._begin(request.initial_pose)
        if value_of(self._values, "force_update_after_set_map", False):
            self._do(Localizer.force_update)
        return [True]

    def _find(self, message: sensor_msgs.msg.LaserScan) -> tuple[StampedTransform, Pose2] | None:
        """Return the poses of laser and robot; None if transforms, or a map, are not available yet."""
        mounted = self.frames.find(self._base, message.header.frame_id.strip("/"))
        odom = self.frames.pose(self._odom, self._base, message.header.stamp.to_nsec())
        if self._localizer is None or mounted is None or odom is None:
            return None
        return mounted, odom

    def _use(
        self, message: sensor_msgs.msg.LaserScan, found: tuple[StampedTransform, Pose2]
    ) -> None:
        """Process a scan."""
        mounted, odom = found
        stamp = message.header.stamp.to_nsec()
        sign = -1.0 if is_upside_down(mounted.rotation) else 1.0
        scan = PlanarScan(
            np.array(message.ranges, np.float64),
            sign * beam_angles(message),
            float(message.range_max),
            float(message.range_min),
            flat(mounted),
        )
        with self._lock:
            localizer = self._localizer
            if localizer is None:
                return
            estimate = localizer.update(odom, scan)
            if estimate is not None:
                self._publish(localizer, stamp)
            if localizer.map_to_odom is not None and self._broadcast:
                later = stamp + self._tolerance_ns
                self.frames.send(self._whole, self._odom, later, localizer.map_to_odom)
        rate = value_of(self._values, "save_pose_rate", 0.5)
        if rate > 0.0 and abs(stamp - self._saved_at) >= SECOND / rate:
            self._saved_at = stamp
            self._save()

    def _publish(self, localizer: Localizer, stamp: int) -> None:
        estimate = localizer.estimate
        if estimate is None:
            return
        message = geometry_msgs.msg.PoseWithCovarianceStamped()
        message.header.frame_id, message.header.stamp = self._whole, Time(nsecs=stamp)
        x, y, yaw = estimate.pose.tolist()
        fill_pose(message.pose.pose, (x, y, yaw))
        covariance = np.zeros((6, 6))
        covariance[:2, :2] = estimate.covariance[:2, :2]
        covariance[5, 5] = estimate.covariance[2, 2]
        message.pose.covariance = covariance.ravel().tolist()
        self._poses.publish(message)
        if self._clouds.num_connections:
            self._clouds.publish(self._cloud(localizer, stamp))

    def _cloud(self, localizer: Localizer, stamp: int) -> geometry_msgs.msg.PoseArray:
        kind = geometry_msgs.msg.Pose
        message = geometry_msgs.msg.PoseArray()
        message.header.frame_id, message.header.stamp = self._whole, Time(nsecs=stamp)
        poses = []
        for x, y, yaw in localizer.filter.poses.tolist():
            pose = kind()
            fill_pose(pose, (x, y, yaw))
            poses.append(pose)
        message.poses = poses
        return message

    def _save(self) -> None:
        """Write the pose to the parameters, where the next one begins."""
        localizer = self._localizer
        if localizer is None or localizer.estimate is None or self._node.closed:
            return
        estimate = localizer.estimate
        for axis, value in zip("xya", estimate.pose.tolist(), strict=True):
            self._node.set_param(f"~initial_pose_{axis}", value)
        for axis, value in zip(("xx", "yy", "aa"), np.diag(estimate.covariance), strict=True):
            self._node.set_param(f"~initial_cov_{axis}", float(value))


class _Tuning:
    """Settings that dynamic_reconfigure changes: all of them."""

    def __init__(self, owner: AmclNode) -> None:
        self._owner = owner
        self._tunables = {
            each.name: _tunable(each.name, getattr(AmclSettings(), each.name))
            for each in dataclasses.fields(AmclSettings)
        }

    @property
    def tunables(self) -> Mapping[str, Tunable]:
        """Settings that can be changed."""
        return self._tunables

    @property
    def values(self) -> dict[str, Any]:
        """Current values."""
        return dataclasses.asdict(self._owner.settings)

    def send(self, /, **requested: Any) -> dict[str, Any]:
        """Set some values; invalid ones stay as they are."""
        try:
            self._owner.apply(AmclSettings.read({**self.values, **requested}))
        except Error:
            return self.values
        return self.values


def _tunable(name: str, default: Any) -> Tunable:
    """Return a setting with its limits."""
    text = name.replace("_", " ")
    if isinstance(default, bool):
        return Tunable(name, default, False, True, text)
    if isinstance(default, str):
        choices = MODELS if name == "odom_model_type" else LASER_MODELS
        return Tunable(name, default, "", "", f"{text}: one of {', '.join(choices)}")
    if isinstance(default, int):
        return Tunable(name, default, 0, 100_000, text)
    least = -1.0 if default < 0.0 else 0.0
    return Tunable(name, default, least, 1000.0, text)
