"""Topic monitor: types, rates, bandwidths and last messages, as rqt_topic shows them."""

from __future__ import annotations

import threading
from typing import Any

from gazelle.viewer.graph.context import GraphContext
from gazelle.viewer.graph.panels.markup import preformatted, table
from gazelle.viewer.graph.panels.panel import GraphPanel
from gazelle.viewer.graph.statuses import Arrivals
from gazelle_ros.messages import MessageException
from gazelle_ros.messages.yaml import to_yaml
from gazelle_ros.raw import RawMessage
from gazelle_ros.typed import decode

_NONE = "none"
_LONGEST = 4000  # characters of a message


class _Watched:
    """One topic: how its messages come, and the last one."""

    def __init__(self, context: GraphContext, topic: str) -> None:
        self.arrivals = Arrivals()
        self.last: Any = None
        self._bytes, self._lock = 0, threading.Lock()
        self._subscriber = context.node.subscribe(topic, RawMessage, self._take, 10)

    def traffic(self) -> float:
        """Return the bytes that came since the last call."""
        with self._lock:
            total, self._bytes = self._bytes, 0
        return float(total)

    def close(self) -> None:
        """Unsubscribe."""
        self._subscriber.close()

    def _take(self, raw: RawMessage) -> None:
        self.arrivals.add()
        self.last = raw
        with self._lock:
            self._bytes += len(raw._buff)


class TopicMonitorPanel(GraphPanel):
    """All topics that fit a filter; rates are measured while a box is ticked.

    Args:
        context: Of the page.
    """

    title = "Topic monitor"

    def __init__(self, context: GraphContext) -> None:
        super().__init__(context)
        self._watched: dict[str, _Watched] = {}

    def build(self) -> None:
        """Add filter, table and the last message of a topic."""
        gui = self.context.gui
        self._filter: Any = gui.add_text("Topics", "", hint="Part of the name or type")
        self._measure: Any = gui.add_checkbox(
            "Measure", initial_value=True, hint="Subscribes to all topics of the table"
        )
        self._table: Any = gui.add_html("")
        self._chosen: Any = gui.add_dropdown("Last message", (_NONE,))
        self._last: Any = gui.add_html("")
        self.inputs = {"filter": self._filter, "measure": self._measure}

    def refresh(self) -> None:
        """Update the table."""
        master = self.context.node.master
        published, subscribed, _ = master.system_state()
        types = dict(master.topic_types())
        part = self._filter.value
        topics = sorted(name for name in types if part in name or part in types[name])
        self._follow([name for name in topics if name in published] if self._measure.value else [])
        rows = [
            (
                (
                    name, types[name], str(len(published.get(name, ()))),
                    str(len(subscribed.get(name, ()))), *self._rates(name),
                ),
                "",
            )
            for name in topics
        ]  # fmt: skip
        self._table.content = table(
            ("Topic", "Type", "Pub", "Sub", "Hz", "kB/s"), rows, ("Topic", "Type")
        )
        options = (_NONE, *sorted(self._watched))
        if tuple(self._chosen.options) != options:
            self._chosen.options = options
        self._last.content = preformatted(self._text(self._watched.get(self._chosen.value)))

    def pause(self) -> None:
        """Unsubscribe from all topics."""
        self._follow([])

    def close(self) -> None:
        """Unsubscribe from all topics."""
        self._follow([])

    def _follow(self, topics: list[str]) -> None:
        for name in set(self._watched) - set(topics):
            self._watched.pop(name).close()
        for name in topics:
            if name not in self._watched:
                self._watched[name] = _Watched(self.context, name)

    def _rates(self, topic: str) -> tuple[str, str]:
        watched = self._watched.get(topic)
        if watched is None:
            return "", ""
        speed = watched.traffic() / self.period / 1e3
        return f"{watched.arrivals.rate:.3g}", f"{speed:.3g}"

    def _text(self, watched: _Watched | None) -> str:
        if watched is None or watched.last is None:
            return ""
        try:
            text = to_yaml(decode(watched.last))
        except MessageException as error:
            return str(error)
        return text if len(text) <= _LONGEST else f"{text[:_LONGEST]} ..."
