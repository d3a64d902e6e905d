"""A node that converts messages once their transform to a frame is known."""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Callable
from typing import Any

from gazelle_ros.builtin.on_demand import OnDemandPublisher
from gazelle_ros.node import Node
from gazelle_ros.tf import StampedTransform, TransformException
from gazelle_ros.tf.listening import FrameListener
from gazelle_ros.tf.scan_queue import MessageQueue

_LOG = logging.getLogger("gazelle.ros.scans")
_PATIENCE_S = 5.0
"""Of wall time, until a missing transform is warned of [s]."""

Conversion = Callable[[Any, StampedTransform], Any]
"""From a message and its transform to a message; a ValueError names what is wrong with it."""


class FramedConversion:
    """Messages of a topic, converted, on another, while that has subscribers.

    Args:
        node: On the graph.
        source: Topic and class of the messages.
        output: Topic and class of what is published.
        frame: Frame that the messages are transformed to; empty for their own.
        convert: Converts one.
        queue_size: Messages that wait for a conversion; older ones are left out.
    """

    def __init__(
        self,
        node: Node,
        *,
        source: tuple[str, Any],
        output: tuple[str, Any],
        frame: str,
        convert: Conversion,
        queue_size: int,
    ) -> None:
        self._node, self._frame, self._convert = node, frame, convert
        self._queue = MessageQueue()
        self._frames = FrameListener(node) if frame else None
        if self._frames is not None:
            self._frames.tree.on_change(self._queue.wake)
        self._good = time.monotonic()
        self._fault = ""

        def begin() -> list[Any]:
            return [node.subscribe(*source, self._queue.add, queue_size)]

        self._output = OnDemandPublisher(node, *output, begin)

    def run(self, stop: threading.Event) -> None:
        """Convert messages as they come, until shutdown."""
        while not stop.is_set() and not self._node.closed:
            self._queue.work(self._find, self._use)
            if self._fault and time.monotonic() - self._good > _PATIENCE_S:
                self._warn(self._fault)

    def _find(self, message: Any) -> StampedTransform | None:
        header = message.header
        own = header.frame_id.strip("/")
        stamp = header.stamp.to_nsec()
        if self._frames is None or own == self._frame.strip("/"):
            return StampedTransform(stamp)
        try:
            return self._frames.tree.lookup(self._frame.strip("/"), own, stamp)
        except TransformException as error:
            self._fault = f"messages wait for their transform: {error}"
            return None

    def _use(self, message: Any, transform: StampedTransform) -> None:
        self._fault = ""
        try:
            made = self._convert(message, transform)
        except ValueError as error:
            if time.monotonic() - self._good > _PATIENCE_S:
                self._warn(f"a message cannot be converted: {error}")
            return
        self._good = time.monotonic()
        if self._frame:
            made.header.frame_id = self._frame
        self._output.publish(made)

    def _warn(self, text: str) -> None:
        self._good, self._fault = time.monotonic(), ""
        _LOG.warning("%s", text)
