"""Turns a ``LaserScan`` into a ``PointCloud2``."""

from __future__ import annotations

from typing import Any

import numpy as np

from gazelle_ros.compat.sensor_msgs.point_cloud2 import PointField, create_cloud


class ChannelOption:
    """Additional channels of a point, as bits."""

    NONE = 0x00
    INTENSITY = 0x01
    INDEX = 0x02
    DISTANCE = 0x04
    TIMESTAMP = 0x08
    VIEWPOINT = 0x10
    DEFAULT = INTENSITY | INDEX


class LaserProjection:
    """Turns scans into clouds; ranges outside the scanner's limits are left out."""

    LASER_SCAN_INVALID = -1.0
    LASER_SCAN_MIN_RANGE = -2.0
    LASER_SCAN_MAX_RANGE = -3.0
    ChannelOption = ChannelOption

    def projectLaser(  # noqa: N802  # laser_geometry's name
        self,
        scan_in: Any,
        range_cutoff: float = -1.0,
        channel_options: int = ChannelOption.DEFAULT,
    ) -> Any:
        """Return the cloud of a scan, in the scan's frame.

        Args:
            scan_in: The ``LaserScan``.
            range_cutoff: Ranges from here on are left out, too [m]; below 0 for no such limit.
            channel_options: Bits of `ChannelOption`.
        """
        ranges = np.asarray(scan_in.ranges, dtype=np.float64)
        limit = scan_in.range_max if range_cutoff < 0 else min(range_cutoff, scan_in.range_max)
        kept = np.flatnonzero((ranges < limit) & (ranges >= scan_in.range_min))
        angles = scan_in.angle_min + kept * scan_in.angle_increment
        near = ranges[kept]
        zeros = np.zeros(len(kept))
        columns = {"x": near * np.cos(angles), "y": near * np.sin(angles), "z": zeros}
        if channel_options & ChannelOption.INTENSITY and len(scan_in.intensities):
            columns["intensity"] = np.asarray(scan_in.intensities)[kept]
        if channel_options & ChannelOption.INDEX:
            columns["index"] = kept
        if channel_options & ChannelOption.DISTANCE:
            columns["distances"] = near
        if channel_options & ChannelOption.TIMESTAMP:
            columns["stamps"] = kept * scan_in.time_increment
        if channel_options & ChannelOption.VIEWPOINT:
            columns |= dict.fromkeys(("vp_x", "vp_y", "vp_z"), zeros)
        fields = [
            PointField(
                name, 4 * place, PointField.INT32 if name == "index" else PointField.FLOAT32, 1
            )
            for place, name in enumerate(columns)
        ]
        return create_cloud(scan_in.header, fields, np.column_stack(list(columns.values())))
