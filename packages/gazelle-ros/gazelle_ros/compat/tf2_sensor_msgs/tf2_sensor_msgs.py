"""Teaches tf2's buffers to transform ``PointCloud2``."""

from __future__ import annotations

import numpy as np

from gazelle_ros.compat.sensor_msgs.point_cloud2 import PointCloud2, create_cloud, read_points
from gazelle_ros.compat.tf2_geometry_msgs import from_msg_msg, to_msg_msg
from gazelle_ros.compat.tf2_kdl import transform_to_kdl
from gazelle_ros.compat.tf2_ros.buffer_interface import ConvertRegistration, TransformRegistration
from gazelle_ros.msgs import geometry_msgs, sensor_msgs
from gazelle_ros.transformations import quaternion_matrix

__all__ = ["do_transform_cloud", "from_msg_msg", "to_msg_msg", "transform_to_kdl"]


def do_transform_cloud(
    cloud: sensor_msgs.msg.PointCloud2, transform: geometry_msgs.msg.TransformStamped
) -> sensor_msgs.msg.PointCloud2:
    """Transform the points of a cloud to the target frame, as a cloud of one row.

    The first three values of a point are its place; the others stay as they are.
    """
    turn, place = transform.transform.rotation, transform.transform.translation
    matrix = quaternion_matrix((turn.x, turn.y, turn.z, turn.w))[:3, :3]
    # Float64 holds every value of a cloud exactly: the widest ints have 32 bits.
    points = np.array(list(read_points(cloud)), dtype=np.float64)
    if len(points):
        points[:, :3] = points[:, :3] @ matrix.T + (place.x, place.y, place.z)
    return create_cloud(transform.header, cloud.fields, points)


TransformRegistration().add(PointCloud2, do_transform_cloud)
ConvertRegistration().add_to_msg(PointCloud2, to_msg_msg)
ConvertRegistration().add_from_msg(PointCloud2, from_msg_msg)
