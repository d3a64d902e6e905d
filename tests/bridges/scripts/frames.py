#!/usr/bin/env python
# ruff: noqa: F401  it is written as people write such scripts
"""Frames with tf and tf2: broadcast from a thread, static, looked up, points transformed."""

import math
import threading

import rospy
import tf
import tf2_geometry_msgs
import tf2_ros
from geometry_msgs.msg import PointStamped, PoseStamped, TransformStamped

rospy.init_node("frames")
listener = tf.TransformListener()
br = tf.TransformBroadcaster()
sbr = tf2_ros.StaticTransformBroadcaster()
s = TransformStamped()
s.header.stamp = rospy.Time.now()
s.header.frame_id, s.child_frame_id = "base_footprint", "camera"
s.transform.translation.x, s.transform.rotation.w = 0.1, 1
sbr.sendTransform(s)
done = threading.Event()


def loop():
    turn = tf.transformations.quaternion_from_euler(0, 0, math.pi / 2)
    rate = rospy.Rate(50)
    while not done.is_set() and not rospy.is_shutdown():
        br.sendTransform((1.0, 0, 0), turn, rospy.Time.now(), "carrot", "odom")
        try:
            rate.sleep()
        except rospy.ROSInterruptException:
            return


thread = threading.Thread(target=loop)
thread.start()
listener.waitForTransform("/odom", "/base_footprint", rospy.Time(), rospy.Duration(4.0))
listener.waitForTransform("/odom", "/carrot", rospy.Time(), rospy.Duration(4.0))
listener.waitForTransform("/camera", "/base_footprint", rospy.Time(), rospy.Duration(4.0))
trans, rot = listener.lookupTransform("/odom", "/base_footprint", rospy.Time(0))
print(len(trans), len(rot), type(trans).__name__)
buf = tf2_ros.Buffer()
tl = tf2_ros.TransformListener(buf)
while True:
    try:
        x = buf.lookup_transform("carrot", "camera", rospy.Time(0), rospy.Duration(1.0))
        break
    except (tf2_ros.LookupException, tf2_ros.ConnectivityException, tf2_ros.ExtrapolationException):
        rospy.sleep(0.1)
print(x.header.frame_id, x.child_frame_id, round(abs(x.transform.rotation.w), 2))
p = PointStamped()
p.header.frame_id, p.point.x = "camera", 1.0
q = listener.transformPoint("base_footprint", p)
print(q.header.frame_id, round(q.point.x, 3))
ps = PoseStamped()
ps.header.frame_id, ps.pose.orientation.w = "camera", 1.0
out = buf.transform(ps, "base_footprint", rospy.Duration(1.0))
print(out.header.frame_id, round(out.pose.position.x, 3))
try:
    listener.lookupTransform("odom", "nowhere", rospy.Time(0))
except (tf.LookupException, tf.ConnectivityException, tf.ExtrapolationException) as e:
    print(type(e).__name__, e)
print(listener.frameExists("camera"), sorted(listener.getFrameStrings()))
done.set()
thread.join()
