"""Clouds as laser scans and back (http://wiki.ros.org/pointcloud_to_laserscan)."""

from __future__ import annotations

import math
import os
import sys
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from gazelle_ros.base.array_types import Floats
from gazelle_ros.base.errors import RosError
from gazelle_ros.base.parameter_values import positive
from gazelle_ros.builtin.arguments import run_node
from gazelle_ros.builtin.parameters import settings_of
from gazelle_ros.builtin.scans.conversion import FramedConversion
from gazelle_ros.builtin.scans.points import cloud_points, moved
from gazelle_ros.compat.laser_geometry import LaserProjection
from gazelle_ros.compat.sensor_msgs.point_cloud2 import create_cloud, split_columns
from gazelle_ros.msgs import sensor_msgs, std_msgs
from gazelle_ros.node import Node
from gazelle_ros.tf import StampedTransform

_LARGEST = sys.float_info.max
_LEAST = sys.float_info.min
_LARGEST_SINGLE = float(np.finfo(np.float32).max)


@dataclass(frozen=True, slots=True)
class CloudScanSettings:
    """Parameters of ``pointcloud_to_laserscan``, with its defaults.

    Attributes:
        target_frame: Frame of the scan; empty for that of the cloud.
        transform_tolerance: Not needed: a cloud waits until its transform is known [s].
        min_height: Smallest z of a point in the frame of the scan [m].
        max_height: Greatest z [m].
        angle_min: Of the first beam [rad].
        angle_max: Of the last beam [rad].
        angle_increment: Between beams [rad].
        scan_time: Duration of the scan by its message [s].
        range_min: Nearer points are left out [m].
        range_max: Farther points are left out [m].
        inf_epsilon: Added to the range of a beam without a point [m], without ``use_inf``.
        use_inf: The range of a beam without a point is infinite, else beyond the greatest.
        concurrency_level: Clouds that may wait; 0 for one a processor.
    """

    target_frame: str = ""
    transform_tolerance: float = 0.01
    min_height: float = _LEAST
    max_height: float = _LARGEST
    angle_min: float = -math.pi
    angle_max: float = math.pi
    angle_increment: float = math.pi / 180.0
    scan_time: float = 1.0 / 30.0
    range_min: float = 0.0
    range_max: float = _LARGEST
    inf_epsilon: float = 1.0
    use_inf: bool = True
    concurrency_level: int = 1


@dataclass(frozen=True, slots=True)
class ScanCloudSettings:
    """Parameters of ``laserscan_to_pointcloud``, with its defaults.

    Attributes:
        target_frame: Frame of the cloud; empty for that of the scan.
        transform_tolerance: Not needed: a scan waits until its transform is known [s].
        concurrency_level: Scans that may wait; 0 for one a processor.
    """

    target_frame: str = ""
    transform_tolerance: float = 0.01
    concurrency_level: int = 1


def pointcloud_to_laserscan(node: Node) -> FramedConversion:
    """Return the work of ``pointcloud_to_laserscan``: ``cloud_in`` as ``scan``.

    Raises:
        Error: A parameter is wrong.
    """
    settings = settings_of(node, CloudScanSettings)
    positive("angle_increment", settings.angle_increment)
    if not settings.angle_max > settings.angle_min:
        raise RosError("angle_max is above angle_min")
    return FramedConversion(
        node,
        source=("cloud_in", sensor_msgs.msg.PointCloud2),
        output=("scan", sensor_msgs.msg.LaserScan),
        frame=settings.target_frame,
        convert=lambda cloud, transform: scan_of_cloud(settings, cloud, transform),
        queue_size=settings.concurrency_level or os.cpu_count() or 1,
    )


def laserscan_to_pointcloud(node: Node) -> FramedConversion:
    """Return the work of ``laserscan_to_pointcloud``: ``scan_in`` as ``cloud``.

    Raises:
        Error: A parameter is wrong.
    """
    settings = settings_of(node, ScanCloudSettings)
    return FramedConversion(
        node,
        source=("scan_in", sensor_msgs.msg.LaserScan),
        output=("cloud", sensor_msgs.msg.PointCloud2),
        frame=settings.target_frame,
        convert=cloud_of_scan,
        queue_size=settings.concurrency_level or os.cpu_count() or 1,
    )


def scan_of_cloud(
    settings: CloudScanSettings, cloud: sensor_msgs.msg.PointCloud2, transform: StampedTransform
) -> sensor_msgs.msg.LaserScan:
    """Return the scan of a cloud: of each beam the nearest point.

    Args:
        settings: Beams and limits.
        cloud: A cloud.
        transform: From its frame to that of the scan.

    Raises:
        ValueError: The cloud has not x, y and z.
    """
    return sensor_msgs.msg.LaserScan(
        header=std_msgs.msg.Header(stamp=cloud.header.stamp, frame_id=cloud.header.frame_id),
        angle_min=settings.angle_min,
        angle_max=settings.angle_max,
        angle_increment=settings.angle_increment,
        scan_time=settings.scan_time,
        range_min=single(settings.range_min),
        range_max=single(settings.range_max),
        ranges=nearest_ranges(settings, moved(transform, cloud_points(cloud))),
    )


def nearest_ranges(settings: CloudScanSettings, points: Floats) -> list[float]:
    """Return the range of each beam [m]: that of the nearest point in its sector.

    Args:
        settings: Beams and limits.
        points: In the frame of the scan, shape (n, 3) [m].
    """
    first, step = settings.angle_min, settings.angle_increment
    # By single precision, as in the message: a full circle in degrees has 360 beams, not 361.
    count = math.ceil(np.float32(settings.angle_max - first) / np.float32(step))
    x, y, z = points.T
    away, angle = np.hypot(x, y), np.arctan2(y, x)
    kept = (z >= settings.min_height) & (z <= settings.max_height)
    kept &= (away >= settings.range_min) & (away <= settings.range_max)
    kept &= (angle >= first) & (angle <= settings.angle_max)
    beam = np.minimum(((angle[kept] - first) / step).astype(np.intp), count - 1)
    empty = math.inf if settings.use_inf else settings.range_max + settings.inf_epsilon
    ranges = np.full(count, empty)
    np.minimum.at(ranges, beam, away[kept])
    return [single(each) for each in ranges.tolist()]


def single(number: float) -> float:
    """Return a number, or infinity if single precision has none as great."""
    return number if abs(number) <= _LARGEST_SINGLE else math.copysign(math.inf, number)


def cloud_of_scan(
    scan: sensor_msgs.msg.LaserScan, transform: StampedTransform
) -> sensor_msgs.msg.PointCloud2:
    """Return a scan's valid ends of beams as a cloud, with intensity and index of the beam."""
    cloud: sensor_msgs.msg.PointCloud2 = LaserProjection().projectLaser(scan)
    return cloud if transform == StampedTransform(transform.stamp) else _moved(cloud, transform)


def _moved(
    cloud: sensor_msgs.msg.PointCloud2, transform: StampedTransform
) -> sensor_msgs.msg.PointCloud2:
    columns = np.stack(list(split_columns(cloud).values()), axis=-1).astype(np.float64)
    columns = columns.reshape(-1, len(cloud.fields))
    columns[:, :3] = moved(transform, columns[:, :3])
    return create_cloud(cloud.header, cloud.fields, columns)


def scan_main(arguments: Sequence[str]) -> int:
    """Convert clouds until shutdown; returns the exit code."""
    return run_node(arguments, "pointcloud_to_laserscan_node", pointcloud_to_laserscan)


def cloud_main(arguments: Sequence[str]) -> int:
    """Convert scans until shutdown; returns the exit code."""
    return run_node(arguments, "laserscan_to_pointcloud_node", laserscan_to_pointcloud)
