"""Hooks of ``rospy.on_shutdown`` may sleep, publish and call, as with the real rospy."""

from __future__ import annotations

import os
import signal
import subprocess
import sys

import pytest
from ros.real import INSTALLED, PYTHON, environment

SCRIPT = """
import rospy
from std_msgs.msg import String

class Robot(object):
    def __init__(self):
        rospy.init_node("robot")
        rospy.on_shutdown(self.shutdown)
        self.pub = rospy.Publisher("words", String, queue_size=1)
        self.heard = []
        rospy.Subscriber("words", String, self.hear)
        rate = rospy.Rate(10)
        while not self.pub.get_num_connections():
            rospy.sleep(0.1)
        print("running", flush=True)
        while not rospy.is_shutdown():
            rate.sleep()

    def hear(self, message):
        print("heard", message.data, flush=True)
        self.heard.append(message)

    def shutdown(self):
        print("stopping", rospy.is_shutdown(), rospy.core.is_shutdown_requested(), flush=True)
        self.pub.publish("stop")
        rospy.sleep(0.3)
        rospy.Rate(10).sleep()
        for _ in range(600):
            if not self.heard:
                rospy.sleep(0.1)
        print("stopped", flush=True)

try:
    Robot()
except rospy.ROSInterruptException:
    pass
"""
SAID = ["running", "stopping False True", "heard stop", "stopped"]


def lines(command, env, file):
    process = subprocess.Popen(
        [*command, str(file)], env=env, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    first = process.stdout.readline()
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=120)
    assert "Traceback" not in err
    return [line for line in (first + out).splitlines() if not line.startswith("[")]


@pytest.fixture
def script(tmp_path):
    file = tmp_path / "robot.py"
    file.write_text(SCRIPT, encoding="utf-8")
    return file


def test_a_hook_may_sleep_and_publish(master, script):
    env = os.environ | {"ROS_MASTER_URI": master.uri}
    assert lines([sys.executable, "-m", "gazelle_ros", "exec"], env, script) == SAID


@pytest.mark.ros
@pytest.mark.skipif(not INSTALLED, reason="the real ROS 1 is not installed (Debian: ros-core)")
def test_a_hook_of_the_real_rospy_says_the_same(master, script):
    assert lines([PYTHON], environment(master.uri), script) == SAID


def test_a_signal_while_the_script_waits_for_the_end_does_not_hang(node):
    from gazelle_ros.compat.rospy.state import process

    process.catch_signals()
    # As when the signal comes while `spin` holds the lock of the event it waits for.
    with process.shutdown._cond:
        os.kill(os.getpid(), signal.SIGINT)
    assert process.shutdown.wait(30)
    process.wait_ended()
