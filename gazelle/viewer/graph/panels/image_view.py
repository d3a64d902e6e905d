"""Images of a topic, as image_view and rqt_image_view show them."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from gazelle.viewer.graph.context import GraphContext
from gazelle.viewer.graph.panels.panel import GraphPanel
from gazelle.viewer.graph.statuses import Arrivals
from gazelle.viewer.sources import picture_of
from gazelle_ros import load_message

_NONE = "choose ..."
_KINDS = ("sensor_msgs/Image", "sensor_msgs/CompressedImage")
_WIDEST_PX = 640
_LIST_S = 1.0  # between two looks at what topics there are


class ImageViewPanel(GraphPanel):
    """Shows the images of one topic, with their size, encoding and rate.

    Args:
        context: Of the page.
    """

    title = "Image view"
    period = 0.1

    def __init__(self, context: GraphContext) -> None:
        super().__init__(context)
        self._subscriber: Any = None
        self._wanted, self._followed, self._next = "", _NONE, 0.0
        self._kinds: dict[str, str] = {}
        self._arrivals, self._last, self._drawn = Arrivals(), None, 0
        self._image: Any = None

    def build(self) -> None:
        """Add the choice of the topic, and a text about its images."""
        gui = self.context.gui
        self._topic: Any = gui.add_dropdown("Topic", (_NONE,))
        self._text: Any = gui.add_markdown("")

    @property
    def settings(self) -> dict[str, Any]:
        """The topic, for a saved layout."""
        return {"topic": self._topic.value}

    def restore(self, settings: Mapping[str, Any]) -> None:
        """Show the topic of a saved layout as soon as it is there."""
        self.use([str(settings.get("topic", ""))])

    def use(self, arguments: Sequence[str]) -> None:
        """Show the topic of a command line as soon as it is there."""
        self._wanted = next((word for word in arguments if not word.startswith("-")), "")

    def refresh(self) -> None:
        """List the topics, and show the last image."""
        if time.monotonic() >= self._next:
            self._next = time.monotonic() + _LIST_S
            self._list()
        if self._topic.value != self._followed or self._subscriber is None:
            self._follow(self._topic.value)
        if self._arrivals.count != self._drawn:
            self._drawn = self._arrivals.count
            self._draw(self._last)

    def pause(self) -> None:
        """Unsubscribe until somebody looks."""
        self._leave()

    def close(self) -> None:
        """Unsubscribe."""
        self._leave()

    def _list(self) -> None:
        types = self.context.node.master.topic_types()
        self._kinds = {name: kind for name, kind in sorted(types) if kind in _KINDS}
        if tuple(self._topic.options) != (_NONE, *self._kinds):
            self._topic.options = (_NONE, *self._kinds)
        if self._wanted in self._kinds:
            self._topic.value, self._wanted = self._wanted, ""

    def _follow(self, topic: str) -> None:
        self._leave()
        self._followed = topic
        if topic not in self._kinds:
            self._text.content = ""
        else:
            kind = load_message(self._kinds[topic])
            self._subscriber = self.context.node.subscribe(topic, kind, self._take, 1)

    def _leave(self) -> None:
        if self._subscriber is not None:
            self._subscriber.close()
            self._subscriber = None
        self._arrivals, self._drawn = Arrivals(), 0

    def _take(self, message: Any) -> None:
        self._last = message
        self._arrivals.add()

    def _draw(self, message: Any) -> None:
        picture = picture_of(message)
        high, wide = picture.shape[:2]
        every = -(-wide // _WIDEST_PX)
        small = np.ascontiguousarray(picture[::every, ::every])
        if self._image is None:
            self._image = self.context.gui.add_image(small, format="jpeg")
        else:
            self._image.image = small
        encoding = getattr(message, "encoding", "") or message.format
        text = f"{wide} x {high}, {encoding}, {self._arrivals.rate:.3g} Hz"
        if self._text.content != text:
            self._text.content = text
