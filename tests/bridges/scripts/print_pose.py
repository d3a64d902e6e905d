#!/usr/bin/env python
# ruff: noqa: F403, F405, UP010, UP031  it is written as people write such scripts
"""Prints where a model is, ten times a second, seen from different frames."""

from __future__ import print_function

import rospy
from gazebo_msgs.srv import *

rospy.init_node("print_pose")
rospy.wait_for_service("/gazebo/get_model_state")
get = rospy.ServiceProxy("/gazebo/get_model_state", GetModelState, persistent=True)
rate = rospy.Rate(10)
seqs = []
last = None
for frame in ["", "world", "map", "r1", "r1::base_footprint", "ground_plane", "nowhere"]:
    try:
        res = get("r1", frame)
        print(
            "%r %s %s [%s] %.1f %.1f"
            % (
                str(frame),
                res.success,
                res.status_message,
                res.header.frame_id,
                abs(res.pose.position.x),
                abs(res.pose.orientation.w),
            )
        )
        if res.success:
            seqs.append(res.header.seq)
            if last is not None and res.header.stamp < last:
                print("time goes back")
            last = res.header.stamp
    except rospy.ServiceException as e:
        rospy.logerr("Service call failed: %s" % e)
    rate.sleep()
print([s - seqs[0] for s in seqs])
links = rospy.ServiceProxy("/gazebo/get_link_state", GetLinkState)
state = links("r1::wheel_left_link", "r1::base_footprint").link_state
print(state.link_name, state.reference_frame, "%.3f" % state.pose.position.y)
print(links("wheel", "").status_message)
props = rospy.ServiceProxy("/gazebo/get_model_properties", GetModelProperties)("r1")
print(sorted(props.joint_names), props.is_static, props.canonical_body_name == "")
