"""Adding displays by hand: by topic or by type, as RViz's dialog."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any

from gazelle.errors import Error
from gazelle.viewer.graph.context import GraphContext
from gazelle_ros import names

_NONE = "choose ..."


class DisplayAdder:
    """Controls that add a display.

    Args:
        context: Of the page.
        kinds: Types of message that are shown.
        add: Called with topic and type.
    """

    def __init__(
        self, context: GraphContext, kinds: Iterable[str], add: Callable[[str, str], None]
    ) -> None:
        self._context, self._add = context, add
        self._offered: dict[str, str] = {}
        gui = context.gui
        with gui.add_folder("Add", expand_by_default=False):
            self._topic: Any = gui.add_dropdown("By topic", (_NONE,))
            self._kind: Any = gui.add_dropdown("By type", tuple(sorted(kinds)))
            self._name: Any = gui.add_text("Its topic", "", hint="May begin to be published later")
            button = gui.add_button("Add display")
        context.on_user_change(self._topic, self._add_offered)
        context.on_user_click(button, self._add_named)

    def offer(self, topics: Mapping[str, str]) -> None:
        """List topics of the graph without a display, with their types."""
        self._offered = dict(sorted(topics.items()))
        options = (_NONE, *self._offered)
        if tuple(self._topic.options) != options:
            self._topic.options = options

    def _add_offered(self) -> None:
        topic = self._topic.value
        if topic in self._offered:
            self._topic.value = _NONE
            self._add(topic, self._offered[topic])

    def _add_named(self) -> None:
        name = self._name.value.strip()
        if not name:
            raise Error("a display needs a topic", hint="such as /scan")
        self._add(self._context.node.resolve(names.check(name)), self._kind.value)
        self._name.value = ""
