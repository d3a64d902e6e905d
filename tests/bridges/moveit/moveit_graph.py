"""A ``move_group`` for Fetch's arm on a graph, and a client of it."""

import contextlib

import arms
import numpy as np
from ros.graph import until

from gazelle.bridges.moveit.move_group import MoveGroupNode
from gazelle_ros import Master, Node, load_message, load_service

READY = {"shoulder_lift_joint": -0.8, "elbow_flex_joint": 1.2, "wrist_flex_joint": -0.4}
LIMITS = {"shoulder_pan_joint": {"has_acceleration_limits": True, "max_acceleration": 6.0}}


def message(name, **fields):
    return load_message(f"moveit_msgs/{name}")(**fields)


class MoveGroupClient:
    """Asks."""

    def __init__(self, node, group):
        self.node, self.group = node, group
        self.joints = node.advertise(
            "joint_states", load_message("sensor_msgs/JointState"), latch=True
        )

    def stand(self, **positions):
        """Publish the joints' state, and wait until it is known there."""
        names = [each.name for each in self.group.context.robot.variables if not each.mimics]
        values = [float((READY | positions).get(name, 0.0)) for name in names]
        self.joints.publish(load_message("sensor_msgs/JointState")(name=names, position=values))
        robot, monitor = self.group.context.robot, self.group.context.monitor
        until(lambda: np.allclose(monitor.current()[robot.columns(names)], values), 60.0)

    def call(self, service, kind, **fields):
        found = load_service(f"moveit_msgs/{kind}")
        self.node.wait_for_service(service, timeout=60)
        return self.node.client(service, found).call(found._request_class(**fields), timeout=60)


def set_parameters(node, srdf="fetch_arm.srdf"):
    node.set_param("/robot_description", (arms.DATA / "fetch_arm.urdf").read_text())
    node.set_param("/robot_description_semantic", (arms.DATA / srdf).read_text())
    node.set_param("/robot_description_planning", {"joint_limits": LIMITS})


@contextlib.contextmanager
def moveit_graph(**own):
    """Run a graph with ``move_group``; keywords are its own parameters."""
    with (
        Master(port=0, rosout=False) as master,
        Node("/asking", master_uri=master.uri) as asking,
    ):
        set_parameters(asking)
        for name, value in own.items():
            asking.set_param(f"/move_group/{name}", value)
        with Node("/move_group", master_uri=master.uri) as node:
            client = MoveGroupClient(asking, MoveGroupNode(node))
            client.stand()
            yield client
