"""Fills a buffer from /tf and /tf_static."""

from __future__ import annotations

import threading
from typing import Any

from gazelle_ros.compat.rospy.logs import logwarn
from gazelle_ros.compat.rospy.rostime import Time, get_rostime
from gazelle_ros.compat.rospy.state import process
from gazelle_ros.compat.rospy.topics import DEFAULT_BUFF_SIZE, Subscriber
from gazelle_ros.msgs import tf2_msgs


class TransformListener:
    """Fills a buffer.

    Args:
        buffer: The buffer.
        queue_size: Messages kept while others are taken; None for all.
        buff_size: Accepted, and not needed.
        tcp_nodelay: Ask for small packets at once.
    """

    def __init__(
        self,
        buffer: Any,
        queue_size: int | None = None,
        buff_size: int = DEFAULT_BUFF_SIZE,
        tcp_nodelay: bool = False,  # noqa: FBT001, FBT002  # tf2_ros's interface
    ) -> None:
        kind = tf2_msgs.msg.TFMessage
        self.buffer = buffer
        self.last_update = Time(0) if process.node is None else get_rostime()
        self._lock = threading.Lock()
        self.tf_sub = Subscriber(
            "/tf", kind, self.callback, None, queue_size, buff_size, tcp_nodelay
        )
        self.tf_static_sub = Subscriber(
            "/tf_static", kind, self.static_callback, None, queue_size, buff_size, tcp_nodelay
        )

    def unregister(self) -> None:
        """Unsubscribe."""
        self.tf_sub.unregister()
        self.tf_static_sub.unregister()

    def check_for_reset(self) -> None:
        """Discard changing transforms if simulated time jumped back."""
        with self._lock:
            now = get_rostime()
            if now < self.last_update:
                jump = (self.last_update - now).to_sec()
                logwarn(f"Detected jump back in time of {jump:f}s. Clearing TF buffer.")
                self.buffer.clear()
            self.last_update = now

    def callback(self, data: tf2_msgs.msg.TFMessage) -> None:
        """Add a message of /tf."""
        self.check_for_reset()
        who = data._connection_header.get("callerid", "default_authority")
        for transform in data.transforms:
            self.buffer.set_transform(transform, who)

    def static_callback(self, data: tf2_msgs.msg.TFMessage) -> None:
        """Add a message of /tf_static."""
        self.check_for_reset()
        who = data._connection_header.get("callerid", "default_authority")
        for transform in data.transforms:
            self.buffer.set_transform_static(transform, who)
