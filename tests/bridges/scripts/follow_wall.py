#!/usr/bin/env python3
# ruff: noqa: UP031  it is written as people write such scripts
"""Keeps a wall at its right side for a while, by the laser."""

import math

import numpy as np
import rospy
from geometry_msgs.msg import Twist
from sensor_msgs.msg import LaserScan


class WallFollower:
    def __init__(self):
        self.scans = 0
        self.nearest = float("inf")
        self.pub = rospy.Publisher("/cmd_vel", Twist, queue_size=1)
        self.sub = rospy.Subscriber("/scan", LaserScan, self.scan, queue_size=1)

    def sector(self, msg, low, high):
        ranges = np.array(msg.ranges)
        ranges[np.isinf(ranges)] = msg.range_max
        angles = np.arange(len(ranges)) * msg.angle_increment + msg.angle_min
        angles = (angles + math.pi) % (2 * math.pi) - math.pi
        return float(np.min(ranges[(angles >= low) & (angles <= high)]))

    def scan(self, msg):
        if self.scans == 0:
            print(
                msg.header.frame_id, len(msg.ranges), "%.2f %.2f" % (msg.angle_min, msg.angle_max)
            )
            print("%.2f %.2f" % (msg.range_min, msg.range_max), type(msg.ranges).__name__)
        self.scans += 1
        front = self.sector(msg, -0.5, 0.5)
        right = self.sector(msg, -1.8, -1.2)
        self.nearest = min(self.nearest, front, right)
        twist = Twist()
        twist.linear.x = 0.15 if front > 0.6 else 0.0
        twist.angular.z = 0.8 if front <= 0.6 else 0.5 * (0.5 - right)
        self.pub.publish(twist)


if __name__ == "__main__":
    rospy.init_node("wall_follower", log_level=rospy.WARN)
    follower = WallFollower()
    rospy.wait_for_message("/scan", LaserScan, timeout=60)
    begin = rospy.Time.now()
    while rospy.Time.now() - begin < rospy.Duration(3):
        rospy.sleep(0.1)
    follower.sub.unregister()
    follower.pub.publish(Twist())
    print("scans", follower.scans >= 8, "free", follower.nearest > 0.15)
