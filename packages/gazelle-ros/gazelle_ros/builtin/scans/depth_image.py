"""Depth images as laser scans (http://wiki.ros.org/depthimage_to_laserscan)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from gazelle_ros.base.tuned_fields import tunable
from gazelle_ros.builtin.arguments import run_node
from gazelle_ros.builtin.images.conversion import (
    TRANSPORT_PARAMETERS,
    ImageConversion,
    camera_topics,
)
from gazelle_ros.builtin.images.depth.metric import depths_of
from gazelle_ros.builtin.parameters import settings_of
from gazelle_ros.builtin.tuned_settings import TunedSettings
from gazelle_ros.msgs import sensor_msgs, std_msgs
from gazelle_ros.node import Node

_KEPT = 10


@dataclass(frozen=True, slots=True)
class DepthScanSettings:
    """Parameters of ``depthimage_to_laserscan``, with its defaults.

    Attributes:
        scan_height: Rows of the image around the optical centre.
        scan_time: Duration of the scan by its message [s].
        range_min: Nearer points are left out [m].
        range_max: Farther points are left out [m].
        output_frame_id: Frame of the scan: that of the camera with x forwards and z up.
    """

    scan_height: int = tunable(1, 1, 500, "Height of the laser band (in pixels).")
    scan_time: float = tunable(0.033, 0.0, 1.0, "Time for the entire scan sweep.")
    range_min: float = tunable(0.45, 0.0, 10.0, "Minimum reported range (in meters).")
    range_max: float = tunable(10.0, 0.0, 10.0, "Maximum reported range (in meters).")
    output_frame_id: str = tunable(
        "camera_depth_frame", description="Output frame_id for the laserscan."
    )


class DepthImageToLaserScan(ImageConversion):
    """Depth images of ``image`` as ``scan``, while that has subscribers.

    The camera is described by ``camera_info`` in the namespace of the images.

    Args:
        node: On the graph.

    Raises:
        Error: A parameter is wrong.
    """

    def __init__(self, node: Node) -> None:
        self._tuned = TunedSettings(
            node,
            settings_of(node, DepthScanSettings, others=TRANSPORT_PARAMETERS),
            lambda _settings: None,
        )
        super().__init__(
            node,
            camera_topics(node, "image"),
            [("scan", sensor_msgs.msg.LaserScan)],
            lambda image, camera: [scan_of_image(self._tuned.settings, image, camera)],
            queue_size=_KEPT,
        )


def scan_of_image(
    settings: DepthScanSettings, image: sensor_msgs.msg.Image, camera: sensor_msgs.msg.CameraInfo
) -> sensor_msgs.msg.LaserScan:
    """Return the scan of a depth image: of each column the nearest valid point.

    Beams are as many as columns, at equal angles; the first is that of the rightmost column.

    Args:
        settings: Rows and limits.
        image: Depth along the optical axis, ``16UC1`` [mm] or ``32FC1`` [m]; rectified.
        camera: Its projection.

    Raises:
        ValueError: The image is of another encoding or not as high as the rows wanted, or the
            camera has no focal length.
    """
    depths = depths_of(image)
    focal, centre_x, centre_y = camera.P[0], camera.P[2], camera.P[6]
    if not focal > 0.0:
        raise ValueError("the camera_info has no focal length (P[0])")
    half = settings.scan_height // 2
    if half > centre_y or half > image.height - centre_y:
        raise ValueError(f"a scan_height of {settings.scan_height} is too great for the image")
    across = (np.arange(image.width) - centre_x) / focal  # of a point at a depth of one
    angles = -np.arctan2(across, 1.0)
    first, last = float(angles[-1]), float(angles[0])
    step = (last - first) / max(image.width - 1, 1)
    top = int(centre_y - half)
    rows = depths[top : top + settings.scan_height]
    return sensor_msgs.msg.LaserScan(
        header=std_msgs.msg.Header(
            stamp=image.header.stamp, frame_id=settings.output_frame_id or image.header.frame_id
        ),
        angle_min=first,
        angle_max=last,
        angle_increment=step,
        scan_time=settings.scan_time,
        range_min=settings.range_min,
        range_max=settings.range_max,
        ranges=_ranges(settings, rows * np.hypot(across, 1.0), (angles - first) / (step or 1.0)),
    )


def _ranges(settings: DepthScanSettings, away: Any, place: Any) -> list[float]:
    """Return the range of each beam [m]; NaN where nothing is known, infinity where nothing is.

    Args:
        settings: Limits.
        away: Distance of each pixel [m], shape (rows, columns).
        place: Angle of each column in beams after the first; shape (columns,).
    """
    beam = np.floor(place + 1e-6).astype(np.intp)  # the outermost column is that of the last beam
    kept = (away >= settings.range_min) & (away <= settings.range_max)
    ranges = np.full(len(beam), np.nan)
    np.fmin.at(ranges, np.broadcast_to(beam, away.shape)[kept], away[kept])
    free = np.zeros(len(beam), bool)
    free[beam[(away == np.inf).any(axis=0)]] = True
    ranges[np.isnan(ranges) & free] = np.inf
    found: list[float] = ranges.tolist()
    return found


def main(arguments: Sequence[str]) -> int:
    """Convert depth images until shutdown; returns the exit code."""
    return run_node(arguments, "depthimage_to_laserscan", DepthImageToLaserScan)
