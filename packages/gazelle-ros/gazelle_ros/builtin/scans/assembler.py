"""Nodes of laser_assembler: clouds of all scans of a period (http://wiki.ros.org/laser_assembler)."""

from __future__ import annotations

import logging
import threading
from abc import abstractmethod
from collections import deque
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from gazelle_ros.base.array_types import Floats
from gazelle_ros.base.errors import RosError
from gazelle_ros.base.parameter_values import Values, value_of, warn_of_unknown
from gazelle_ros.builtin.arguments import run_node
from gazelle_ros.builtin.parameters import private_values
from gazelle_ros.builtin.scans.conversion import StampedWork
from gazelle_ros.builtin.scans.filters.beams import BeamScan, ScanMotion, beam_scan, with_motions
from gazelle_ros.builtin.scans.filters.chain import frames_of, scan_filters
from gazelle_ros.builtin.scans.points import moved
from gazelle_ros.clock import SECOND
from gazelle_ros.compat.sensor_msgs.point_cloud2 import PointField, create_cloud, split_columns
from gazelle_ros.msgs import geometry_msgs, laser_assembler, sensor_msgs, std_msgs
from gazelle_ros.node import Node
from gazelle_ros.tf import StampedTransform
from gazelle_ros.time import Time

_CLOUDS, _CACHE_S, _QUEUE = 400, 10.0, 10
_PARAMETERS = ("fixed_frame", "tf_cache_time_secs", "downsample_factor")
_LOG = logging.getLogger("gazelle.ros.scans")


@dataclass(frozen=True, slots=True)
class CloudPart:
    """Points of one message in the fixed frame.

    Attributes:
        stamp: Time of the message [ns].
        points: Shape (n, 3) [m].
        channels: Other values of the points by name, each of shape (n,).
    """

    stamp: int
    points: Floats
    channels: Mapping[str, Floats]


class CloudHistory:
    """The newest clouds.

    Args:
        most: Clouds kept.
        every: Of the clouds of a period, and of the points of each, one out of so many is returned.
    """

    def __init__(self, most: int, every: int = 1) -> None:
        self._parts: deque[CloudPart] = deque(maxlen=most)
        self._every = every
        self._lock = threading.Lock()

    def add(self, part: CloudPart) -> None:
        """Add a cloud, which must be newer than those before."""
        with self._lock:
            self._parts.append(part)

    def within(self, begin: int, end: int) -> CloudPart:
        """Return the points of a period in one cloud.

        Args:
            begin: First time [ns].
            end: Time before which clouds are taken [ns].

        Returns:
            Points of the clouds, with the channels of the first one and the time of the last one; a cloud of
            the time ``end`` without points if there are none.
        """
        with self._lock:
            chosen = [each for each in self._parts if begin <= each.stamp < end][:: self._every]
        if not chosen:
            return CloudPart(end, np.zeros((0, 3)), {})
        points = np.concatenate([each.points[:: self._every] for each in chosen])
        channels = {
            name: np.concatenate([_values(each, name)[:: self._every] for each in chosen])
            for name in chosen[0].channels
        }
        return CloudPart(chosen[-1].stamp, points, channels)


def _values(part: CloudPart, name: str) -> Floats:
    """Return a channel of a cloud; NaN where it has none of that name."""
    found = part.channels.get(name)
    return np.full(len(part.points), np.nan) if found is None else found


class CloudAssembler(StampedWork[Any]):
    """A history of clouds in a fixed frame, and its services.

    Args:
        node: On the graph, with the parameter ``~fixed_frame``.
        source: Topic and class of the messages.
        most: Parameter for the number of messages kept.
        others: Parameters that are read elsewhere.
        frames: More frames that transforms are needed to.

    Raises:
        Error: A parameter is missing or wrong.
    """

    def __init__(
        self,
        node: Node,
        source: tuple[str, Any],
        most: str,
        *,
        others: Collection[str] = (),
        frames: Collection[str] = (),
    ) -> None:
        values = private_values(node)
        warn_of_unknown(node.resolve("~"), values, (*_PARAMETERS, most, *others))
        self.frame = value_of(values, "fixed_frame", "").strip("/")
        if not self.frame:
            raise RosError(f"{node.resolve('~fixed_frame')} is not set to a frame")
        cache = value_of(values, "tf_cache_time_secs", _CACHE_S)
        kept, every = _count(values, most, _CLOUDS, 0), _count(values, "downsample_factor", 1, 1)
        if not 0.0 <= cache < 1e9:
            raise RosError(f"'tf_cache_time_secs' is 0 or more, not {cache}")
        super().__init__(node, {self.frame, *frames}, _QUEUE, cache_ns=round(cache * SECOND))
        self.history = CloudHistory(kept, every)
        srv = laser_assembler.srv
        for name, old in (("assemble_scans", "build_cloud"), ("assemble_scans2", "build_cloud2")):
            kind = srv.AssembleScans2 if name.endswith("2") else srv.AssembleScans
            answer = self._cloud2 if name.endswith("2") else self._cloud
            node.serve(name, kind, answer)
            node.serve(old, kind, answer)
        node.subscribe(*source, self.queue.add, _QUEUE)

    @abstractmethod
    def part(self, message: Any, found: Any) -> CloudPart:
        """Return the points of a message in the fixed frame.

        Raises:
            ValueError: It is malformed.
        """

    def find(self, message: Any) -> Any:
        """Return the transform of a message to the fixed frame.

        Raises:
            TransformException: It is not known.
        """
        own, stamp = message.header.frame_id.strip("/"), message.header.stamp.to_nsec()
        return self.tree.lookup(self.frame, own, stamp)

    def use(self, message: Any, transforms: Any) -> None:
        """Keep the points of a message.

        Raises:
            ValueError: It is malformed.
        """
        self.history.add(self.part(message, transforms))

    def _found(self, request: Any) -> tuple[std_msgs.msg.Header, CloudPart]:
        part = self.history.within(request.begin.to_nsec(), request.end.to_nsec())
        return std_msgs.msg.Header(stamp=Time(nsecs=part.stamp), frame_id=self.frame), part

    def _cloud(self, request: laser_assembler.srv.AssembleScansRequest) -> list[Any]:
        header, part = self._found(request)
        point, channel = geometry_msgs.msg.Point32, sensor_msgs.msg.ChannelFloat32
        made = sensor_msgs.msg.PointCloud(header=header)
        made.points = [point(x, y, z) for x, y, z in part.points.tolist()]
        made.channels = [channel(name, values) for name, values in part.channels.items()]
        return [made]

    def _cloud2(self, request: laser_assembler.srv.AssembleScans2Request) -> list[Any]:
        header, part = self._found(request)
        columns = np.column_stack((part.points, *part.channels.values()))
        fields = [
            PointField(name, 4 * place, PointField.FLOAT32, 1)
            for place, name in enumerate(("x", "y", "z", *part.channels))
        ]
        return [create_cloud(header, fields, columns)]


class ScanAssembler(CloudAssembler):
    """Scans of ``scan``, filtered by ``~filters``.

    Args:
        node: On the graph. With ``~ignore_laser_skew`` false, beams have places of their own times.

    Raises:
        Error: A parameter is missing or wrong.
    """

    def __init__(self, node: Node) -> None:
        values = private_values(node)
        self._still = value_of(values, "ignore_laser_skew", True)
        self.filters = scan_filters(node.resolve("~filters"), values.get("filters", []))
        super().__init__(
            node,
            ("scan", sensor_msgs.msg.LaserScan),
            "max_scans",
            others=("ignore_laser_skew", "filters"),
            frames=frames_of(self.filters),
        )

    def find(self, message: Any) -> BeamScan:
        """Return a scan with its motions.

        Raises:
            TransformException: One is not known.
        """
        scan = beam_scan(message)
        if not self._still:
            return with_motions(scan, self.tree, {self.frame, *frames_of(self.filters)})
        at = super().find(message)
        motions = {self.frame: ScanMotion(at, at)}
        return with_motions(scan, self.tree, frames_of(self.filters), motions)

    def part(self, message: Any, found: BeamScan) -> CloudPart:
        """Return the valid ends of beams, with their intensities and numbers.

        With motions of the beams they have distances [m] and times since the first beam [s], too.

        Raises:
            ValueError: It cannot be filtered.
        """
        del message
        for each in self.filters:
            found = each.apply(found)
        points = found.points_in(self.frame)
        kept = np.flatnonzero(np.isfinite(points[:, 0]))
        channels: dict[str, Floats] = {}
        if len(found.intensities) == len(found.ranges):
            channels["intensity"] = np.asarray(found.intensities[kept], np.float64)
        channels["index"] = kept.astype(np.float64)
        if not self._still:
            channels["distances"] = np.asarray(found.ranges[kept], np.float64)
            channels["stamps"] = kept.astype(np.float64) * found.time_increment
        return CloudPart(found.stamp, points[kept], channels)


class PointCloudAssembler(CloudAssembler):
    """Clouds of the older kind, ``PointCloud``, of ``cloud``.

    Args:
        node: On the graph.

    Raises:
        Error: A parameter is missing or wrong.
    """

    def __init__(self, node: Node) -> None:
        super().__init__(node, ("cloud", sensor_msgs.msg.PointCloud), "max_clouds")

    def part(self, message: Any, found: StampedTransform) -> CloudPart:
        """Return the points of a cloud in the fixed frame.

        Raises:
            ValueError: A channel has not a value for each point.
        """
        points = np.array([(each.x, each.y, each.z) for each in message.points]).reshape(-1, 3)
        channels = {each.name: np.asarray(each.values, np.float64) for each in message.channels}
        for name, values in channels.items():
            if len(values) != len(points):
                raise ValueError(f"'{name}' has {len(values)} values for {len(points)} points")
        return CloudPart(message.header.stamp.to_nsec(), moved(found, points), channels)


class PointCloud2Assembler(CloudAssembler):
    """Clouds of ``cloud``.

    Args:
        node: On the graph.

    Raises:
        Error: A parameter is missing or wrong.
    """

    def __init__(self, node: Node) -> None:
        super().__init__(node, ("cloud", sensor_msgs.msg.PointCloud2), "max_clouds")

    def part(self, message: Any, found: StampedTransform) -> CloudPart:
        """Return the points of a cloud in the fixed frame, with its other fields of one value.

        Raises:
            ValueError: It has not x, y and z, or less data than its sizes say.
        """
        columns = split_columns(message)
        missing = [axis for axis in "xyz" if axis not in columns]
        if missing:
            raise ValueError(f"the cloud has no field '{missing[0]}'; it has {sorted(columns)}")
        single = {
            name: values.ravel().astype(np.float64)
            for name, values in columns.items()
            if values.ndim == 2
        }
        points = np.column_stack([single.pop(axis) for axis in "xyz"])
        return CloudPart(message.header.stamp.to_nsec(), moved(found, points), single)


def scan_main(arguments: Sequence[str]) -> int:
    """Collect scans until shutdown; returns the exit code."""
    return run_node(arguments, "laser_scan_assembler", ScanAssembler)


def cloud_main(arguments: Sequence[str]) -> int:
    """Collect clouds of the older kind until shutdown; returns the exit code."""
    return run_node(arguments, "point_cloud_assembler", PointCloudAssembler)


def cloud2_main(arguments: Sequence[str]) -> int:
    """Collect clouds until shutdown; returns the exit code."""
    return run_node(arguments, "point_cloud_assembler", PointCloud2Assembler)


def _count(values: Values, name: str, default: int, least: int) -> int:
    """Return a number of things; the default, with an error in the log, where it is too small."""
    found: int = value_of(values, name, default)
    if found < least:
        _LOG.error("'%s' is at least %d, not %d: %d is used", name, least, found, default)
        return default
    return found
