#!/usr/bin/env python3
# ruff: noqa: UP031  it is written as people write such scripts
"""Lets a box hover by wrenches, as drones of beginners do."""

import rospy
from gazebo_msgs.srv import (
    ApplyBodyWrench,
    BodyRequest,
    DeleteModel,
    GetLinkProperties,
    GetModelState,
    SpawnModel,
)
from geometry_msgs.msg import Point, Pose, Wrench

DRONE = """<sdf version="1.6"><model name="drone"><link name="body">
<inertial><mass>1.5</mass><inertia><ixx>0.02</ixx><iyy>0.02</iyy><izz>0.04</izz></inertia></inertial>
<collision name="c"><geometry><box><size>0.4 0.4 0.1</size></box></geometry></collision>
</link></model></sdf>"""
HEIGHT = 1.0


def main():
    rospy.init_node("hover")
    rospy.wait_for_service("/gazebo/apply_body_wrench")
    spawn = rospy.ServiceProxy("/gazebo/spawn_sdf_model", SpawnModel)
    wrench = rospy.ServiceProxy("/gazebo/apply_body_wrench", ApplyBodyWrench)
    clear = rospy.ServiceProxy("/gazebo/clear_body_wrenches", BodyRequest)
    state = rospy.ServiceProxy("/gazebo/get_model_state", GetModelState)
    pose = Pose()
    pose.position.x, pose.position.z = -1.0, 0.3
    pose.orientation.w = 1.0
    print(spawn("drone", DRONE, "", pose, "world").status_message)
    mass = rospy.ServiceProxy("/gazebo/get_link_properties", GetLinkProperties)("drone::body").mass
    print("mass %.1f" % mass)
    rate = rospy.Rate(50)
    begin = rospy.get_time()
    while rospy.get_time() - begin < 3.0 and not rospy.is_shutdown():
        now = state("drone", "world")
        push = Wrench()
        push.force.z = mass * (
            9.8 + 8.0 * (HEIGHT - now.pose.position.z) - 5.0 * now.twist.linear.z
        )
        clear("drone::body")
        wrench("drone::body", "", Point(0, 0, 0), push, rospy.Time(0), rospy.Duration(-1))
        rate.sleep()
    now = state("drone", "")
    print(
        "height",
        abs(now.pose.position.z - HEIGHT) < 0.2,
        "level",
        abs(now.pose.orientation.w) > 0.99,
    )
    clear("drone::body")
    rospy.sleep(1.0)
    print("falls", state("drone", "").pose.position.z < 0.5)
    late = wrench(body_name="nothing", wrench=Wrench())
    print(late.success, late.status_message)
    print(rospy.ServiceProxy("/gazebo/delete_model", DeleteModel)("drone").status_message)


if __name__ == "__main__":
    main()
