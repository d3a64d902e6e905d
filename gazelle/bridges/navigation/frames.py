"""The frames of a graph, as a navigation node sees them, and what of them is missing."""

from __future__ import annotations

import numpy as np

from gazelle.array_types import Floats
from gazelle.bridges.conversions import set_point, set_quaternion
from gazelle.description import Pose
from gazelle.navigation.following import Pose2
from gazelle.rotations import rotate, yaw_of
from gazelle_ros.msgs import geometry_msgs, tf2_msgs
from gazelle_ros.node import Node
from gazelle_ros.tf import FrameTree, StampedTransform, TransformException
from gazelle_ros.tf.listening import FrameListener
from gazelle_ros.time import Time


class GraphFrames(FrameListener):
    """Listens to ``/tf`` and ``/tf_static``, and sends transforms of its own.

    Args:
        node: On the graph.
    """

    def __init__(self, node: Node) -> None:
        super().__init__(node)
        self._stamped = geometry_msgs.msg.TransformStamped
        self._kind = tf2_msgs.msg.TFMessage
        self._sender = node.advertise("/tf", self._kind, queue_size=100)

    def send(self, parent: str, child: str, stamp: int, pose: Pose2) -> None:
        """Publish the pose of a frame in the plane of its parent, from a time on [ns]."""
        self.send_in_space(parent, child, stamp, Pose(x=pose[0], y=pose[1], yaw=pose[2]))

    def send_in_space(self, parent: str, child: str, stamp: int, pose: Pose) -> None:
        """Publish the pose of a frame in its parent, from a time on [ns]."""
        message = self._stamped()
        message.header.frame_id, message.child_frame_id = parent, child
        message.header.stamp = Time(nsecs=stamp)
        set_point(message.transform.translation, pose.position)
        set_quaternion(message.transform.rotation, pose.quaternion)
        self._sender.publish(self._kind(transforms=[message]))

    def pose(self, target: str, source: str, stamp: int = 0) -> Pose2 | None:
        """Return the pose of a frame in another, projected to the plane; None if unknown."""
        found = self.find(target, source, stamp)
        return None if found is None else flat(found)


def flat(transform: StampedTransform) -> Pose2:
    """Return a transform, projected to the plane."""
    x, y, _ = transform.translation
    return x, y, float(yaw_of(np.array(transform.rotation)))


def applied(transform: StampedTransform, points: Floats) -> Floats:
    """Return points, shape (n, 3), transformed."""
    moved: Floats = rotate(np.array(transform.rotation), points) + np.array(transform.translation)
    return moved


def missing_links(tree: FrameTree, whole: str, odom: str, base: str, sensor: str = "") -> list[str]:
    """Return the missing links from map to odometry to base to sensor, each with its usual sender.

    Args:
        tree: Known transforms.
        whole: Frame of the map; empty if it is not needed.
        odom: Frame of the odometry.
        base: Frame of the robot.
        sensor: Frame of the laser; empty if it is not needed or not known yet.
    """
    links = (
        (whole, odom, "amcl or a SLAM node such as slam_gmapping sends it, once it has scans and odometry"),
        (odom, base, "the robot's drive sends it (in a simulation its drive plugin; is the simulation paused?)"),
        (base, sensor, "robot_state_publisher sends it from robot_description, or a static_transform_publisher"),
    )  # fmt: skip
    found = []
    for parent, child, who in links:
        if parent and child and not _connected(tree, parent, child):
            found.append(f"'{parent}' to '{child}' ({who})")
    return found


def _connected(tree: FrameTree, parent: str, child: str) -> bool:
    try:
        tree.lookup(parent, child, 0)
    except TransformException:
        return False
    return True
