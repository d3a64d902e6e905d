"""Sends transforms on /tf."""

from __future__ import annotations

from typing import Any

from gazelle.ros.compat.rospy.topics import Publisher
from gazelle.ros.messages import load_message


class TransformBroadcaster:
    """Sends transforms that hold at the time they are stamped with."""

    def __init__(self) -> None:
        self._kind = load_message("tf2_msgs/TFMessage")
        self.pub_tf = Publisher("/tf", self._kind, queue_size=100)

    def sendTransform(self, transform: Any) -> None:  # noqa: N802  # tf2_ros's name
        """Send a ``TransformStamped``, or a list of them."""
        several = isinstance(transform, (list, tuple))
        self.pub_tf.publish(self._kind(transform if several else [transform]))
