#!/usr/bin/env python3
# ruff: noqa: PTH119, UP031  it is written as people write such scripts
"""Starts all that it needs by name, as learning environments for Gazebo do, and ends it."""

import os
import shlex
import subprocess
import time

import rosgraph
import rosnode
import rospkg
import rospy
from gazebo_msgs.srv import (
    GetPhysicsProperties,
    GetWorldProperties,
    SetPhysicsProperties,
    SpawnModel,
)
from geometry_msgs.msg import Pose
from std_srvs.srv import Empty

LAUNCH = "roslaunch gazebo_ros empty_world.launch paused:=true gui:=false use_clock_frequency:=true"
QUIET = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}


def gazebo(name, kind, *arguments):
    rospy.wait_for_service("/gazebo/" + name, 60)
    return rospy.ServiceProxy("/gazebo/" + name, kind)(*arguments)


if __name__ == "__main__":
    print("master", rosgraph.is_master_online())
    core = subprocess.Popen("exec roscore", shell=True, **QUIET)
    rospy.init_node("session")
    print(os.path.basename(rospkg.RosPack().get_path("gazebo_ros")))
    launch = subprocess.Popen(shlex.split(LAUNCH), **QUIET)
    physics = gazebo("get_physics_properties", GetPhysicsProperties)
    faster = (physics.time_step, 5000.0, physics.gravity, physics.ode_config)
    print(gazebo("set_physics_properties", SetPhysicsProperties, *faster).status_message)
    place = "$(rospack find turtlebot3_description)/urdf/turtlebot3_burger.urdf.xacro"
    urdf = subprocess.check_output("xacro " + place, shell=True).decode()
    rospy.set_param("/tb/robot_description", urdf)
    print(gazebo("spawn_urdf_model", SpawnModel, "tb", urdf, "/tb", Pose(), "").status_message)
    command = "rosrun robot_state_publisher robot_state_publisher __ns:=/tb"
    publisher = subprocess.Popen(shlex.split(command), **QUIET)
    subprocess.check_call("gz world -m 20", shell=True)
    print("time %.3f" % gazebo("get_world_properties", GetWorldProperties).sim_time)
    while "/tb/robot_state_publisher" not in rosnode.get_node_names():
        time.sleep(0.1)
    rosnode.kill_nodes(["/tb/robot_state_publisher"])
    print("publisher", publisher.wait())
    print("gzserver", bool(subprocess.check_output("pgrep -x gzserver", shell=True)))
    launch.terminate()
    print("launch", launch.wait())
    launch = subprocess.Popen(shlex.split(LAUNCH), **QUIET)
    gazebo("unpause_physics", Empty)
    before = rospy.get_time()
    rospy.sleep(0.1)
    print("again", rospy.get_time() > before)
    launch.terminate()
    launch.wait()
    core.terminate()
    print("core", core.wait())
