#!/usr/bin/env python3
# ruff: noqa: B007, PLW1510, PTH118, PTH208, UP031  it is written as people write such scripts
"""Common uses of the command-line tools from Python, and of the modules behind them."""

import os
import signal
import subprocess
import tempfile
import time

import rosbag
import rospy
import rosservice
import rostopic

rospy.init_node("tools")


def sh(command):
    done = subprocess.run(command, shell=True, capture_output=True, text=True, timeout=60)
    return done.returncode, done.stdout.strip()


print(
    sh("rosservice call /gazebo/pause_physics '{}'"), sh("rosservice call /gazebo/unpause_physics")
)
print(sh("rostopic list | grep scan"), sh("rostopic type /scan"), sh("rosnode list | grep gazebo"))
code, out = sh("rostopic echo -n 1 /odom/pose/pose/position")
print(code, len(out.split("\n")))
print(sh("rosparam get /use_sim_time"), sh("rosservice type /gazebo/spawn_urdf_model"))
print(sh("rosservice call /gazebo/get_model_state '{model_name: r1}' | grep success"))
print(os.system("rosservice call /gazebo/reset_world > /dev/null"))
print("/gazebo/set_model_state" in rosservice.get_service_list())
print(rostopic.get_topic_type("/scan", blocking=False)[0])

folder = tempfile.TemporaryDirectory()
path = os.path.join(folder.name, "a.bag")
command = ["rosbag", "record", "-q", "-O", path, "/odom", "/scan"]
recorder = subprocess.Popen(command, stdout=subprocess.DEVNULL)
# Its beginning takes long on a busy machine.
while recorder.poll() is None and not os.listdir(folder.name):
    time.sleep(0.1)
time.sleep(3)
recorder.send_signal(signal.SIGINT)
recorder.wait()
seen = set()
with rosbag.Bag(path) as bag:
    for topic, msg, t in bag.read_messages(topics=["/odom", "/scan"]):
        seen.add(topic)
print(sorted(seen))
print(sh("rosbag info -y -k topics %s | grep topic:" % path)[1].split())
folder.cleanup()
