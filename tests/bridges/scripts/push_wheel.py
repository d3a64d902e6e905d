#!/usr/bin/env python3
# ruff: noqa: F405, UP031  it is written as people write such scripts
"""Turns a wheel of a stand-alone model by efforts, and sets joints where they shall be."""

import rospy
from gazebo_msgs.srv import *  # noqa: F403
from geometry_msgs.msg import Pose

ROBOT = """<?xml version="1.0"?>
<robot name="spinner">
  <link name="world"/>
  <joint name="fix" type="fixed"><parent link="world"/><child link="base"/><origin xyz="0 1.3 0.5"/></joint>
  <link name="base"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="spin" type="continuous"><parent link="base"/><child link="disc"/><axis xyz="0 0 1"/></joint>
  <link name="disc"><inertial><mass value="1"/><inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>
</robot>"""

rospy.init_node("push_wheel")
spawn = rospy.ServiceProxy("/gazebo/spawn_urdf_model", SpawnModel)
spawn.wait_for_service(5.0)
print(spawn("spinner", ROBOT, "", Pose(), "world"))
effort = rospy.ServiceProxy("/gazebo/apply_joint_effort", ApplyJointEffort)
joint = rospy.ServiceProxy("/gazebo/get_joint_properties", GetJointProperties)
clear = rospy.ServiceProxy("/gazebo/clear_joint_forces", JointRequest)
print(effort("spin", 0.2, rospy.Time(0), rospy.Duration(0.5)).status_message)
rospy.sleep(0.8)
spinning = joint("spin")
print(spinning.success, spinning.type == spinning.REVOLUTE, "%.1f" % spinning.rate[0])
clear("spin")
place = rospy.ServiceProxy("/gazebo/set_model_configuration", SetModelConfiguration)
print(place("spinner", "robot_description", ["spin"], [0.0]).status_message)
print(place("spinner", "", ["spin", "other"], [0.0]).status_message)
print(joint("none").status_message, effort(joint_name="none").success)
print(rospy.ServiceProxy("/gazebo/delete_model", DeleteModel)("spinner").success)
