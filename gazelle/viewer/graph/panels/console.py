"""Console: what nodes log, with levels and filters, as rqt_console shows it."""

from __future__ import annotations

import threading
import time
from collections import deque
from typing import Any

from gazelle.viewer.graph.context import GraphContext
from gazelle.viewer.graph.panels.markup import Row, table
from gazelle.viewer.graph.panels.panel import GraphPanel
from gazelle_ros.msgs import rosgraph_msgs

_LEVELS = {"Debug": 1, "Info": 2, "Warn": 4, "Error": 8, "Fatal": 16}
_COLORS = {4: "#d9822b", 8: "#d64545", 16: "#d64545"}
_KEPT, _SHOWN = 2000, 200


class ConsolePanel(GraphPanel):
    """Messages of /rosout, newest first.

    Args:
        context: Of the page.
    """

    title = "Console"
    period = 0.5

    def __init__(self, context: GraphContext) -> None:
        super().__init__(context)
        self._records: deque[rosgraph_msgs.msg.Log] = deque(maxlen=_KEPT)
        self._lock, self._count = threading.Lock(), 0
        self._drawn: Any = None
        self._subscriber = context.node.subscribe("/rosout", rosgraph_msgs.msg.Log, self._take, 200)

    def build(self) -> None:
        """Add the filters and the table."""
        gui = self.context.gui
        self._level: Any = gui.add_dropdown("At least", tuple(_LEVELS), initial_value="Info")
        self._node: Any = gui.add_text("Node", "", hint="Part of the node's name")
        self._text: Any = gui.add_text("Text", "", hint="Part of the message")
        self._pause: Any = gui.add_checkbox("Pause", initial_value=False)
        self._table: Any = gui.add_html("")
        clear = gui.add_button("Clear")
        self.context.on_user_click(clear, self._clear)
        self.inputs = {"level": self._level, "node": self._node, "text": self._text}

    def refresh(self) -> None:
        """Show the messages that pass the filters."""
        if self._pause.value:
            return
        with self._lock:
            records, count = list(self._records), self._count
        now = (count, len(records), self._level.value, self._node.value, self._text.value)
        if now == self._drawn:
            return
        self._drawn = now
        least = _LEVELS[self._level.value]
        node, text = self._node.value.lower(), self._text.value.lower()
        passed = [
            each
            for each in records
            if each.level >= least and node in each.name.lower() and text in each.msg.lower()
        ]
        rows = [_row(each) for each in reversed(passed[-_SHOWN:])]
        self._table.content = table(("Time", "Level", "Node", "Message"), rows, ("Message",))

    def close(self) -> None:
        """Unsubscribe."""
        self._subscriber.close()

    def _take(self, record: rosgraph_msgs.msg.Log) -> None:
        with self._lock:
            self._records.append(record)
            self._count += 1

    def _clear(self) -> None:
        with self._lock:
            self._records.clear()


def _row(record: rosgraph_msgs.msg.Log) -> Row:
    stamp = record.header.stamp
    clock = time.strftime("%H:%M:%S", time.localtime(stamp.secs))
    names = {value: name for name, value in _LEVELS.items()}
    cells = (
        f"{clock}.{stamp.nsecs // 1_000_000:03}", names.get(record.level, str(record.level)),
        record.name, record.msg,
    )  # fmt: skip
    return cells, _COLORS.get(record.level, "")
