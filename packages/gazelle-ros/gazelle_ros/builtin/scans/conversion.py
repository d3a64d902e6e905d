"""Nodes that use messages in their order, each when its transforms are known."""

from __future__ import annotations

import logging
import threading
import time
from abc import ABC, abstractmethod
from collections.abc import Callable, Collection
from typing import Any, Generic, TypeVar

from gazelle_ros.builtin.on_demand import OnDemandOutputs
from gazelle_ros.node import Node
from gazelle_ros.tf import FrameTree, StampedTransform, TransformException
from gazelle_ros.tf.core import DEFAULT_CACHE_NS
from gazelle_ros.tf.listening import FrameListener
from gazelle_ros.tf.scan_queue import KEPT, MessageQueue

_LOG = logging.getLogger("gazelle.ros.scans")
_PATIENCE_S = 5.0
"""Of wall time, until a missing transform is warned of, and between warnings [s]."""

Found = TypeVar("Found")
Conversion = Callable[[Any, StampedTransform], Any]
"""From a message and its transform to a message; a ValueError names what is wrong with it."""


class StampedWork(ABC, Generic[Found]):
    """Work on messages with a stamp.

    Args:
        node: On the graph.
        frames: Frames that transforms are needed to; without any, no transform is listened to.
        kept: Messages that wait, the newest ones.
        cache_ns: Time for which transforms are kept [ns].

    Attributes:
        queue: Messages that wait for their transforms.
        tree: Frames that are known.
    """

    def __init__(
        self,
        node: Node,
        frames: Collection[str],
        kept: int = KEPT,
        *,
        cache_ns: int = DEFAULT_CACHE_NS,
    ) -> None:
        self._node = node
        self.queue = MessageQueue(kept)
        self.tree = FrameTree()
        if frames:
            self.tree = FrameListener(node, cache_ns).tree
            self.tree.on_change(self.queue.wake)
        self._good = time.monotonic()
        self._warned = -_PATIENCE_S
        self._fault = ""

    @abstractmethod
    def find(self, message: Any) -> Found:
        """Return what a message needs of the frames.

        Raises:
            TransformException: A transform is not known.
        """

    @abstractmethod
    def use(self, message: Any, transforms: Found) -> None:
        """Use a message.

        Raises:
            ValueError: It is malformed.
        """

    def run(self, stop: threading.Event) -> None:
        """Use messages as they come, until shutdown."""
        while not stop.is_set() and not self._node.closed:
            self.queue.work(self._look, self._try)
            if self._fault and time.monotonic() - self._good > _PATIENCE_S:
                self._warn(f"messages wait for their transform: {self._fault}")

    def _look(self, message: Any) -> Found | None:
        try:
            return self.find(message)
        except TransformException as error:
            self._fault = str(error)
            return None

    def _try(self, message: Any, found: Found) -> None:
        self._fault, self._good = "", time.monotonic()
        try:
            self.use(message, found)
        except ValueError as error:
            self._warn(f"a message cannot be used: {error}")

    def _warn(self, text: str) -> None:
        if time.monotonic() - self._warned >= _PATIENCE_S:
            self._warned = time.monotonic()
            _LOG.warning("%s: %s", self._node.name, text)


class FramedConversion(StampedWork[StampedTransform]):
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
        super().__init__(node, {frame} - {""})
        self._frame, self._convert = frame, convert

        def begin() -> list[Any]:
            return [node.subscribe(*source, self.queue.add, queue_size)]

        self._output = OnDemandOutputs(node, [output], begin)

    def find(self, message: Any) -> StampedTransform:
        """Return the transform of a message.

        Raises:
            TransformException: It is not known.
        """
        own, target = message.header.frame_id.strip("/"), self._frame.strip("/")
        stamp = message.header.stamp.to_nsec()
        if own == target or not target:
            return StampedTransform(stamp)
        return self.tree.lookup(target, own, stamp)

    def use(self, message: Any, transforms: StampedTransform) -> None:
        """Publish a message, converted.

        Raises:
            ValueError: It is malformed.
        """
        made = self._convert(message, transforms)
        if self._frame:
            made.header.frame_id = self._frame
        self._output.publish(made)
