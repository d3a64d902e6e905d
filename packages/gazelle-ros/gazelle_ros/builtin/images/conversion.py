"""Nodes that convert images and what belongs to them, while the results have subscribers."""

from __future__ import annotations

import logging
import math
import time
from collections.abc import Callable, Sequence
from typing import Any

from gazelle_ros import names
from gazelle_ros.base.errors import RosError
from gazelle_ros.builtin.arguments import CallbackWork
from gazelle_ros.builtin.on_demand import OnDemandOutputs
from gazelle_ros.compat.cv_bridge import CvBridgeError
from gazelle_ros.compat.message_filters import (
    ApproximateTimeSynchronizer,
    SimpleFilter,
    TimeSynchronizer,
)
from gazelle_ros.msgs import sensor_msgs
from gazelle_ros.node import Node
from gazelle_ros.subscribing import Subscriber

Topics = Sequence[tuple[str, Any]]
"""Topics and the classes of their messages."""
Convert = Callable[..., Sequence[Any]]
"""From a message of each source to one for each output, None for none. A ValueError, CvBridgeError or
RosError names what is wrong with them."""

QUEUE = 5
TRANSPORT_PARAMETERS = (
    "image_transport",
    "compressed",
    "compressed_image_transport",
    "compressedDepth",
)
"""Parameters of transports, which are all raw here."""
_SLOP_S = 0.1
_QUIET_S = 1.0
_LOG = logging.getLogger("gazelle.ros.images")


class ImageConversion(CallbackWork):
    """Messages of some topics, converted, on others, while these have subscribers.

    Args:
        node: On the graph.
        sources: Topics to subscribe to.
        outputs: Topics to publish on.
        convert: Converts messages of the same time.
        queue_size: Messages of each source that wait for the others.
        exact: Whether times are the very same; else they are close.

    Attributes:
        outputs: Published outputs.
    """

    def __init__(
        self,
        node: Node,
        sources: Topics,
        outputs: Topics,
        convert: Convert,
        *,
        queue_size: int = QUEUE,
        exact: bool = True,
    ) -> None:
        super().__init__(node)
        self._sources, self._convert, self._queue_size = (
            _resolved(node, sources),
            convert,
            queue_size,
        )
        self._warned = -math.inf
        self._filters = [SimpleFilter() for _ in sources]
        if exact:
            together = TimeSynchronizer(self._filters, queue_size)
        else:
            together = ApproximateTimeSynchronizer(self._filters, queue_size, _SLOP_S)
        together.registerCallback(self._take)
        self.outputs = OnDemandOutputs(node, _resolved(node, outputs), self._begin)

    def _begin(self) -> list[Subscriber]:
        return [
            self.node.subscribe(topic, kind, each.signalMessage, self._queue_size)
            for (topic, kind), each in zip(self._sources, self._filters, strict=True)
        ]

    def _take(self, *messages: Any) -> None:
        try:
            found = self._convert(*messages)
        except (ValueError, CvBridgeError, RosError) as error:
            now = time.monotonic()
            if now - self._warned > _QUIET_S:
                self._warned = now
                _LOG.warning("%s: an image cannot be converted: %s", self.node.name, error)
        else:
            self.outputs.publish(*found)


def camera_topics(node: Node, image: str) -> Topics:
    """Return the topics of a camera: its images, and ``camera_info`` in their namespace."""
    topic = _resolve(node, image)
    return [
        (topic, sensor_msgs.msg.Image),
        (names.namespace_of(topic) + "camera_info", sensor_msgs.msg.CameraInfo),
    ]


def _resolved(node: Node, topics: Topics) -> Topics:
    return [(_resolve(node, topic), kind) for topic, kind in topics]


def _resolve(node: Node, topic: str) -> str:
    """Return the global name of a topic, remapped as a whole or by its namespace.

    ``rgb:=color`` makes ``rgb/camera_info`` ``color/camera_info``, as node handles of roscpp do.
    """
    namespace, _, name = topic.rpartition("/")
    if not namespace or names.is_global(topic):
        return node.resolve(topic)
    return node.resolve(f"{node.resolve(namespace)}/{name}")
