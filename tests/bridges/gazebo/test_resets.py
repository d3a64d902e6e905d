"""Resets with what usually listens attached: nothing breaks, and everything begins anew."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest
from ros.graph import until

from gazelle.clients import Processes, load_urdf

SCRIPT = """
import sys
import rospy, tf2_ros
from nav_msgs.msg import Odometry
from sensor_msgs.msg import JointState, LaserScan
from std_srvs.srv import Empty
rospy.init_node("watcher")
buffer = tf2_ros.Buffer(); listener = tf2_ros.TransformListener(buffer)
reset = rospy.ServiceProxy("/gazebo/reset_simulation", Empty, persistent=True)
KINDS = {"/odom": Odometry, "/scan": LaserScan, "/joint_states": JointState}
first = {topic: [] for topic in KINDS}
for topic, kind in KINDS.items():
    rospy.Subscriber(topic, kind, first[topic].append)
rospy.wait_for_service("/gazebo/reset_simulation")
for topic, kind in KINDS.items():
    rospy.wait_for_message(topic, kind)
def at_zero(topic):
    while True:
        assert not rospy.is_shutdown()
        for message in list(first[topic]):
            if message.header.stamp.is_zero():
                return message
def observed():
    odom, scan, joints = (at_zero(topic) for topic in KINDS)
    place, speed = odom.pose.pose.position, odom.twist.twist.linear
    return (place.x, place.y, speed.x), tuple(scan.ranges), tuple(joints.position)
initial = None
for number in range(int(sys.argv[1])):
    for messages in first.values():
        del messages[:]
    reset()
    now = observed()
    initial = initial or now
    assert max(abs(value) for value in now[0]) < 1e-6, now[0]
    assert now == initial, (number, now, initial)
seen = buffer.lookup_transform("odom", "wheel_left_link", rospy.Time(0), rospy.Duration(5))
print("resets", int(sys.argv[1]), seen.child_frame_id, flush=True)
"""


def reset_often(graph, tmp_path, count):
    """Reset with a robot_state_publisher and a script with a tf listener."""
    script = tmp_path / "watcher.py"
    script.write_text(SCRIPT, encoding="utf-8")
    load_urdf(
        graph.client.node,
        "urdf/turtlebot3_burger.urdf.xacro",
        package="turtlebot3_description",
        parameter="/robot_description",
    )
    graph.sim.robots["r1"].inputs["cmd_vel"].send(0.1)
    with Processes(graph.master.uri) as processes:
        processes.start_node("robot_state_publisher", "robot_state_publisher")
        until(lambda: "/robot_state_publisher" in processes.nodes())
        said = _execute(graph.master.uri, script, count)
        assert "/robot_state_publisher" in processes.nodes()
        assert processes.running
    return said


def _execute(uri, script, count):
    finished = subprocess.run(
        [sys.executable, "-m", "gazelle", "exec", str(script), str(count)],
        env={**os.environ, "ROS_MASTER_URI": uri},
        capture_output=True,
        text=True,
        timeout=1700,
        check=False,
    )
    assert finished.returncode == 0, finished.stdout + finished.stderr
    assert "Traceback" not in finished.stderr, finished.stderr
    return finished.stdout


@pytest.mark.long
def test_after_every_reset_the_first_observation_is_the_initial_one(running, tmp_path):
    assert "resets 30 wheel_left_link" in reset_often(running, tmp_path, 30)


@pytest.mark.slow
@pytest.mark.timeout(1800)
def test_ten_thousand_resets_break_nothing(running, tmp_path):
    assert "resets 10000" in reset_often(running, tmp_path, 10_000)
