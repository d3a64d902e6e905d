#!/usr/bin/env python3
# ruff: noqa: UP004  it is written as people write such scripts
"""Drives straight on until odometry says it is far enough, and compares with tf."""

import rospy
import tf
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry


class Driver(object):
    def __init__(self, distance):
        self.distance = distance
        self.odom = None
        self.listener = tf.TransformListener()
        self.pub = rospy.Publisher("cmd_vel", Twist, queue_size=10)
        self.sub = rospy.Subscriber("odom", Odometry, self.callback)
        rospy.on_shutdown(self.stop)

    def callback(self, msg):
        self.odom = msg

    def stop(self):
        self.pub.publish(Twist())

    def run(self):
        rate = rospy.Rate(20)
        while self.odom is None and not rospy.is_shutdown():
            rate.sleep()
        start = self.odom.pose.pose.position.x
        twist = Twist()
        twist.linear.x = 0.22
        while not rospy.is_shutdown():
            if self.odom.pose.pose.position.x - start >= self.distance:
                break
            self.pub.publish(twist)
            rate.sleep()
        self.stop()
        rospy.sleep(0.5)
        print("frames", self.odom.header.frame_id, self.odom.child_frame_id)
        driven = self.odom.pose.pose.position.x - start
        print("driven enough", self.distance <= driven < self.distance + 0.3)
        print("standing", abs(self.odom.twist.twist.linear.x) < 0.02)
        self.listener.waitForTransform("odom", "base_footprint", rospy.Time(), rospy.Duration(4.0))
        place, _ = self.listener.lookupTransform("/odom", "/base_footprint", rospy.Time(0))
        print("tf agrees", abs(place[0] - self.odom.pose.pose.position.x) < 0.02)
        try:
            self.listener.lookupTransform("odom", "camera", rospy.Time(0))
        except (tf.LookupException, tf.ConnectivityException, tf.ExtrapolationException) as e:
            print(type(e).__name__)


if __name__ == "__main__":
    rospy.init_node("driver")
    Driver(rospy.get_param("~distance", 0.2)).run()
