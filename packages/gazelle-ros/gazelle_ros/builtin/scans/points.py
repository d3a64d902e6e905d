"""Points of clouds and of scans as arrays."""

from __future__ import annotations

import numpy as np

from gazelle_ros.base.array_types import Floats
from gazelle_ros.base.rotations import matrix
from gazelle_ros.compat.sensor_msgs.point_cloud2 import split_columns
from gazelle_ros.msgs import sensor_msgs
from gazelle_ros.tf import StampedTransform


def cloud_points(cloud: sensor_msgs.msg.PointCloud2) -> Floats:
    """Return the finite points of a cloud in its frame, shape (n, 3) [m].

    Raises:
        ValueError: It has not x, y and z, or less data than its sizes say.
    """
    columns = split_columns(cloud)
    missing = [axis for axis in "xyz" if axis not in columns]
    if missing:
        raise ValueError(f"the cloud has no field '{missing[0]}'; it has {sorted(columns)}")
    points: Floats = np.stack([columns[axis].ravel() for axis in "xyz"], axis=-1).astype(np.float64)
    finite: Floats = points[np.isfinite(points).all(axis=1)]
    return finite


def moved(transform: StampedTransform, points: Floats) -> Floats:
    """Return points, shape (n, 3), transformed to the target frame."""
    turned = points @ np.array(matrix(transform.rotation)).T
    found: Floats = turned + np.array(transform.translation)
    return found


def beam_angles(scan: sensor_msgs.msg.LaserScan) -> Floats:
    """Return the angles of a scan's beams in its frame [rad], shape (n,)."""
    count = len(scan.ranges)
    return np.asarray(scan.angle_min + scan.angle_increment * np.arange(count), np.float64)
