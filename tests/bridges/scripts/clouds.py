#!/usr/bin/env python3
"""Scans as arrays and clouds, and scans beside odometry."""

import message_filters
import numpy as np
import rospy
import sensor_msgs.point_cloud2 as pc2
from laser_geometry import LaserProjection
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Imu, LaserScan, PointCloud2

seen = []


def callback(scan, odom):
    ranges = np.array(scan.ranges)
    ranges[np.isinf(ranges)] = scan.range_max
    angles = scan.angle_min + np.arange(len(ranges)) * scan.angle_increment
    points = np.stack((ranges * np.cos(angles), ranges * np.sin(angles)), axis=1)
    cloud = projection.projectLaser(scan)
    pub.publish(cloud)
    if not seen:
        found = list(pc2.read_points(cloud, field_names=("x", "y", "z"), skip_nans=True))
        print(points.shape, cloud.header.frame_id, len(found) > 10, [f.name for f in cloud.fields])
        flat = pc2.create_cloud_xyz32(scan.header, [(1, 2, 3), (4, 5, 6)])
        print(flat.width, flat.point_step)
        print(abs((scan.header.stamp - odom.header.stamp).to_sec()) < 0.1, odom.child_frame_id)
    seen.append(scan)
    if len(seen) == 3:
        rospy.signal_shutdown("enough")


rospy.init_node("clouds")
projection = LaserProjection()
pub = rospy.Publisher("cloud", PointCloud2, queue_size=1)
cache = message_filters.Cache(message_filters.Subscriber("/imu", Imu), 100)
subs = [
    message_filters.Subscriber("/scan", LaserScan),
    message_filters.Subscriber("/odom", Odometry),
]
ts = message_filters.ApproximateTimeSynchronizer(subs, 10, 0.1, allow_headerless=True)
ts.registerCallback(callback)
rospy.spin()
print(len(seen) >= 3, cache.getLastestTime() is not None)
