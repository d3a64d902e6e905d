"""Sends transforms on /tf, in tf's older way."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from gazelle_ros.compat.rospy.topics import Publisher
from gazelle_ros.msgs import geometry_msgs, tf2_msgs


class TransformBroadcaster:
    """Sends transforms.

    Args:
        queue_size: Messages kept for a slow listener.
    """

    def __init__(self, queue_size: int = 100) -> None:
        self._many = tf2_msgs.msg.TFMessage
        self._one = geometry_msgs.msg.TransformStamped
        self.pub_tf = Publisher("/tf", self._many, queue_size=queue_size)

    def sendTransform(  # noqa: N802  # tf's name
        self,
        translation: Sequence[float],
        rotation: Sequence[float],
        time: Any,
        child: str,
        parent: str,
    ) -> None:
        """Send a transform.

        Args:
            translation: Of the child in the parent [m], shape (3,).
            rotation: (x, y, z, w).
            time: Its time.
            child: Name of the frame.
            parent: Name of the frame it is in.
        """
        message = self._one()
        message.header.frame_id, message.header.stamp = parent, time
        message.child_frame_id = child
        place, turn = message.transform.translation, message.transform.rotation
        place.x, place.y, place.z = translation
        turn.x, turn.y, turn.z, turn.w = rotation
        self.sendTransformMessage(message)

    def sendTransformMessage(  # noqa: N802
        self,
        transform: geometry_msgs.msg.TransformStamped
        | list[geometry_msgs.msg.TransformStamped]
        | tuple[geometry_msgs.msg.TransformStamped, ...],
    ) -> None:
        """Send a ``TransformStamped``, or a list of them."""
        several = list(transform) if isinstance(transform, list | tuple) else [transform]
        self.pub_tf.publish(self._many(several))
