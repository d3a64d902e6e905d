"""Servers of interactive markers on the graph."""

from __future__ import annotations

import threading
from collections.abc import Mapping
from typing import Any

from gazelle.viewer.graph.context import GraphContext
from gazelle.viewer.graph.interactive.marker import PageMarker
from gazelle_ros.msgs import visualization_msgs

KIND = "visualization_msgs/InteractiveMarkerInit"
_FULL, _UPDATE, _FEEDBACK = "/update_full", "/update", "/feedback"
_KEEP_ALIVE = 0

_Init = visualization_msgs.msg.InteractiveMarkerInit
_Change = visualization_msgs.msg.InteractiveMarkerUpdate
_Message = _Init | _Change


class _Server:
    """The markers of one server."""

    def __init__(self, context: GraphContext, space: str) -> None:
        self._context, self._space = context, space
        self._lock = threading.Lock()
        self._fresh: list[_Message] = []
        self._begun = False
        self.markers: dict[str, PageMarker] = {}
        self.fault = ""
        node, messages = context.node, visualization_msgs.msg
        self._feedback = node.advertise(
            f"{space}{_FEEDBACK}", messages.InteractiveMarkerFeedback, 100
        )
        self._subscribers = [
            node.subscribe(f"{space}{_FULL}", _Init, self._take, 100),
            node.subscribe(f"{space}{_UPDATE}", _Change, self._take, 100),
        ]
        self.shown: Any = context.gui.add_checkbox(space, initial_value=True)

    def draw(self) -> None:
        """Apply what the server sent, and move markers to their frames."""
        with self._lock:
            fresh, self._fresh = self._fresh, []
        for message in fresh:
            if isinstance(message, _Init):
                if not self._begun:
                    self._begun = True
                    for marker in message.markers:
                        self._add(marker)
            elif self._begun and message.type != _KEEP_ALIVE:
                self._change(message)
        fixed, shown = self._context.fixed, bool(self.shown.value)
        faults = [each.place(fixed, shown=shown) for each in self.markers.values()]
        self.fault = next(filter(None, faults), "")

    def _change(self, message: _Change) -> None:
        for name in message.erases:
            if name in self.markers:
                self.markers.pop(name).remove()
        for marker in message.markers:
            self._add(marker)
        for each in message.poses:
            if each.name in self.markers:
                self.markers[each.name].move(each.header, each.pose)

    def _add(self, message: Any) -> None:
        if message.name in self.markers:
            self.markers.pop(message.name).remove()
        root = f"/interactive{self._space}/{message.name.replace('/', '_')}"
        self.markers[message.name] = PageMarker(
            self._context, root, message, self._feedback.publish
        )

    def _take(self, message: _Message) -> None:
        with self._lock:
            self._fresh.append(message)


class InteractiveServers:
    """All servers of interactive markers, each with a switch on the page.

    Args:
        context: Of the page.
    """

    def __init__(self, context: GraphContext) -> None:
        self._context = context
        self._servers: dict[str, _Server] = {}
        self._folder: Any = context.gui.add_folder("Interactive markers", visible=False)

    @property
    def faults(self) -> list[str]:
        """Faults of servers, each with its name."""
        return [f"{name}: {each.fault}" for name, each in self._servers.items() if each.fault]

    def discover(self, types: Mapping[str, str]) -> None:
        """Show the markers of servers that are new.

        Args:
            types: Of all topics.
        """
        for topic, kind in types.items():
            space = topic.removesuffix(_FULL)
            if kind == KIND and space != topic and space not in self._servers:
                self._folder.visible = True
                with self._folder:
                    self._servers[space] = _Server(self._context, space)

    def draw(self) -> None:
        """Show new values."""
        for server in self._servers.values():
            server.draw()
