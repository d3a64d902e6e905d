"""The frames of a graph, as a node receives them."""

from __future__ import annotations

from gazelle_ros.clock import SECOND
from gazelle_ros.msgs import tf2_msgs
from gazelle_ros.node import Node
from gazelle_ros.tf.core import DEFAULT_CACHE_NS, FrameTree, StampedTransform
from gazelle_ros.tf.errors import TransformException
from gazelle_ros.tf.taking import take_transforms

_BACK_NS = SECOND
"""A jump back that is longer than this begins time again [ns]."""


class FrameListener:
    """Listens to ``/tf`` and ``/tf_static``.

    Args:
        node: On the graph.
        cache_ns: Time for which transforms are kept [ns].

    Attributes:
        tree: All that is known.
    """

    def __init__(self, node: Node, cache_ns: int = DEFAULT_CACHE_NS) -> None:
        self._node = node
        self.tree = FrameTree(cache_ns)
        self._latest = 0
        kind = tf2_msgs.msg.TFMessage
        node.subscribe("/tf", kind, lambda message: self._take(message, static=False))
        node.subscribe("/tf_static", kind, lambda message: self._take(message, static=True))

    def _take(self, message: tf2_msgs.msg.TFMessage, *, static: bool) -> None:
        now = self._node.clock.now()
        if now < self._latest - _BACK_NS:
            self.tree.clear()
            self._latest = now
        self._latest = max(self._latest, now)
        take_transforms(self.tree, message, authority=self._node.name, static=static)

    def find(self, target: str, source: str, stamp: int = 0) -> StampedTransform | None:
        """Return the transform between frames at a time [ns], or the newest; None if unknown."""
        try:
            return self.tree.lookup(target, source, stamp)
        except TransformException:
            return None

    def latest(self, target: str, source: str) -> int:
        """Return the newest time at which a transform is known [ns]; 0 if there is none."""
        try:
            return self.tree.latest_common_time(target, source)
        except TransformException:
            return 0
