"""The node ``/rosout``: it copies what all nodes log to ``/rosout_agg``, as it comes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gazelle_ros.loggers import serve_loggers
from gazelle_ros.msgs import rosgraph_msgs
from gazelle_ros.raw import RawMessage

if TYPE_CHECKING:
    from gazelle_ros.node import Node


class LogMessage(RawMessage):
    """A ``rosgraph_msgs/Log`` that is not decoded."""

    __slots__ = ()
    _type = "rosgraph_msgs/Log"
    _md5sum = "acffd30cd6b6de30f120938c17c593fb"
    _full_text = ""


class RosoutAggregator:
    """Aggregator of logs: a viewer follows one publisher instead of one for each node.

    Args:
        node: The node that does it; it goes by wall time.
    """

    def __init__(self, node: Node) -> None:
        kind = _log_class()
        self._node = node
        self._publisher = self._node.advertise("/rosout_agg", kind, queue_size=1000)
        self._node.subscribe("/rosout", kind, self._pass_on, queue_size=1000)
        serve_loggers(self._node)

    def close(self) -> None:
        """Close the node."""
        self._node.close()

    def _pass_on(self, message: rosgraph_msgs.msg.Log) -> None:
        if self._publisher.has_subscribers:
            self._publisher.publish(message)


def _log_class() -> type[RawMessage]:
    """Return the raw class, with the definition that subscribers without it need."""
    LogMessage._full_text = rosgraph_msgs.msg.Log._full_text
    return LogMessage
