"""Publisher: messages from YAML, once or repeatedly, as rqt_publisher sends them."""

from __future__ import annotations

import time
from typing import Any

from gazelle.errors import Error
from gazelle.viewer.graph.context import GraphContext
from gazelle.viewer.graph.panels.panel import GraphPanel
from gazelle_ros import Time, load_message
from gazelle_ros.messages.yaml import from_yaml, to_yaml
from gazelle_ros.msgs import std_msgs


class PublisherPanel(GraphPanel):
    """Publishes one message, written in YAML.

    Args:
        context: Of the page.
    """

    title = "Publisher"
    period = 0.02

    def __init__(self, context: GraphContext) -> None:
        super().__init__(context)
        self._publisher: Any = None
        self._next = 0.0

    def build(self) -> None:
        """Add topic, type and text of the message."""
        gui, context = self.context.gui, self.context
        self._topic: Any = gui.add_text("Topic", "", hint="Such as /cmd_vel")
        self._kind: Any = gui.add_text("Type", "", hint="Filled in for a known topic")
        self._text: Any = gui.add_text(
            "Message", "", multiline=True, hint="YAML; now and auto stand for time and header"
        )
        self._rate: Any = gui.add_number("Rate [Hz]", 1.0, min=0.01, max=50.0, step=0.1)
        self._repeat: Any = gui.add_checkbox("Repeat", initial_value=False)
        context.on_user_click(gui.add_button("Publish once"), self.publish)
        context.on_user_change(self._topic, self._find_type)
        context.on_user_change(self._kind, self._fill)
        context.on_user_change(self._repeat, self._check)
        self.inputs = {
            "topic": self._topic, "type": self._kind, "message": self._text, "rate": self._rate
        }  # fmt: skip

    def refresh(self) -> None:
        """Publish when it is time."""
        now = time.monotonic()
        if self._repeat.value and now >= self._next:
            self._next = max(self._next + 1.0 / self._rate.value, now)
            try:
                self.publish()
            except Error:
                self._repeat.value = False
                raise

    def publish(self) -> None:
        """Publish the message once.

        Raises:
            Error: Topic or type is unknown, or the text does not fit the type.
        """
        kind = load_message(self._kind.value)
        now = Time(0, self.context.node.clock.now())
        keys = {"now": now, "auto": std_msgs.msg.Header(stamp=now)}
        sent = from_yaml(kind, self._text.value, keys)
        name = self.context.node.resolve(self._topic.value)
        if self._publisher is None or self._publisher.name != name:
            self._withdraw()
            self._publisher = self.context.node.advertise(name, kind, 10, latch=True)
        self._publisher.publish(sent)

    def pause(self) -> None:
        """Publish nothing while no page is open."""
        self._repeat.value = False

    def close(self) -> None:
        """Leave the topic."""
        self._withdraw()

    def _find_type(self) -> None:
        """Fill in the type of a topic that the master knows."""
        name = self.context.node.resolve(self._topic.value)
        found = dict(self.context.node.master.topic_types()).get(name)
        if found and found != "*":
            self._kind.value = found
            self._fill()

    def _fill(self) -> None:
        """Fill in a message of zeros."""
        self._withdraw()
        self._text.value = to_yaml(load_message(self._kind.value)())

    def _check(self) -> None:
        self._next = 0.0

    def _withdraw(self) -> None:
        if self._publisher is not None:
            self._publisher.close()
            self._publisher = None
