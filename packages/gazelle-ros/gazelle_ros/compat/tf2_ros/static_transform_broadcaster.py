"""Sends transforms that never change on /tf_static."""

from __future__ import annotations

import threading
from typing import Any

from gazelle_ros.compat.rospy.topics import Publisher
from gazelle_ros.msgs import geometry_msgs, tf2_msgs


class _Shared:
    """Transforms of all broadcasters of the process, so that a later one hides no earlier one."""

    def __init__(self) -> None:
        self.lock = threading.Lock()
        self.publisher: Publisher | None = None
        self.sent: dict[str, Any] = {}

    def open(self) -> Publisher:
        with self.lock:
            if self.publisher is None or self.publisher.closed:
                kind = tf2_msgs.msg.TFMessage
                self.publisher = Publisher("/tf_static", kind, queue_size=100, latch=True)
                self.sent = {}
            return self.publisher


_shared = _Shared()


class StaticTransformBroadcaster:
    """Sends transforms that hold at all times, to late listeners, too."""

    def __init__(self) -> None:
        self.pub_tf = _shared.open()

    def sendTransform(  # noqa: N802  # tf2_ros's name
        self,
        transform: geometry_msgs.msg.TransformStamped
        | list[geometry_msgs.msg.TransformStamped]
        | tuple[geometry_msgs.msg.TransformStamped, ...],
    ) -> None:
        """Send a ``TransformStamped``, or a list of them."""
        with _shared.lock:
            for each in transform if isinstance(transform, (list, tuple)) else [transform]:
                _shared.sent[each.child_frame_id] = each
            self.pub_tf.publish(list(_shared.sent.values()))
