"""Controllers that are enabled and disabled by topics."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from gazelle_ros.msgs import std_msgs
from gazelle_ros.node import Node

_QUEUE = 10


class EnableSwitch:
    """State set by ``~enable`` and ``~disable``.

    Args:
        node: On the graph.
        on: State at first.
        kind: Class of the messages that enable.
        change: Called with each message, after the state has changed.

    Attributes:
        on: Whether it is enabled.
    """

    def __init__(
        self,
        node: Node,
        *,
        on: bool = True,
        kind: Any = std_msgs.msg.Empty,
        change: Callable[[Any], object] = lambda _message: None,
    ) -> None:
        self.on, self._change = on, change
        node.subscribe("~enable", kind, self._enable, _QUEUE)
        node.subscribe("~disable", std_msgs.msg.Empty, self._disable, _QUEUE)

    def _enable(self, message: Any) -> None:
        self.on = True
        self._change(message)

    def _disable(self, message: std_msgs.msg.Empty) -> None:
        self.on = False
        self._change(message)
