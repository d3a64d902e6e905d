"""Sends transforms on /tf."""

from __future__ import annotations

from gazelle_ros.compat.rospy.topics import Publisher
from gazelle_ros.msgs import geometry_msgs, tf2_msgs


class TransformBroadcaster:
    """Sends transforms that hold at the time they are stamped with."""

    def __init__(self) -> None:
        self._kind = tf2_msgs.msg.TFMessage
        self.pub_tf = Publisher("/tf", self._kind, queue_size=100)

    def sendTransform(  # noqa: N802  # tf2_ros's name
        self,
        transform: geometry_msgs.msg.TransformStamped
        | list[geometry_msgs.msg.TransformStamped]
        | tuple[geometry_msgs.msg.TransformStamped, ...],
    ) -> None:
        """Send a ``TransformStamped``, or a list of them."""
        several = list(transform) if isinstance(transform, list | tuple) else [transform]
        self.pub_tf.publish(self._kind(several))
