"""A graph with ``move_group`` and fake controllers, and a script's process on it with rospy."""

import contextlib
import importlib
import sys
import threading

import pytest
from bridges.moveit.moveit_graph import READY, moveit_graph

import gazelle_ros as ros
from gazelle_ros import load_message
from gazelle_ros.time import Time

TORSO = "torso_lift_joint"
ARM = (
    "shoulder_pan_joint",
    "shoulder_lift_joint",
    "upperarm_roll_joint",
    "elbow_flex_joint",
    "forearm_roll_joint",
    "wrist_flex_joint",
    "wrist_roll_joint",
)
FAKE = [
    {"name": "fake_arm", "type": "last point", "joints": [TORSO, *ARM]},
    {"name": "fake_hand", "type": "last point", "joints": ["r_gripper_finger_joint", "l_gripper_finger_joint"]},
]  # fmt: skip
_PERIOD_S = 0.02


class SpokenJoints:
    """Says where joints are again and again, as joint_state_publisher does."""

    def __init__(self, client):
        self._client, self._end = client, threading.Event()
        robot = client.group.context.robot
        self.where = {
            each.name: READY.get(each.name, 0.0) for each in robot.variables if not each.mimics
        }
        client.node.subscribe(
            "move_group/fake_controller_joint_states",
            load_message("sensor_msgs/JointState"),
            self._hear,
        )
        self._thread = threading.Thread(target=self._say)
        self._thread.start()

    def _hear(self, message):
        news = dict(zip(message.name, message.position, strict=True))
        self.where |= {name: value for name, value in news.items() if name in self.where}

    def _say(self):
        while not self._end.wait(_PERIOD_S):
            where = dict(self.where)
            message = load_message("sensor_msgs/JointState")(
                name=[*where], position=[*where.values()]
            )
            message.header.stamp = Time(nsecs=self._client.node.clock.now())
            self._client.joints.publish(message)

    def close(self):
        self._end.set()
        self._thread.join()


@contextlib.contextmanager
def commander_graph(**own):
    """Run a graph; yields the client of `moveit_graph`, and ``moveit_commander``."""
    with contextlib.ExitStack() as stack, pytest.MonkeyPatch.context() as patch:
        client = stack.enter_context(moveit_graph(controller_list=FAKE, **own))
        patch.setenv("ROS_MASTER_URI", client.node.master_uri)
        patch.setattr(sys, "argv", ["script"])
        stack.callback(SpokenJoints(client).close)
        stack.enter_context(ros.install())
        from gazelle_ros.compat.rospy import client as rospy_client

        rospy_client.reset()
        stack.callback(rospy_client.reset)
        rospy_client.init_node("script", disable_signals=True)
        yield client, importlib.import_module("moveit_commander")
