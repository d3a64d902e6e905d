"""Images of topics, as image_view and rqt_image_view show them."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from gazelle.errors import Error
from gazelle.viewer.graph.context import GraphContext
from gazelle.viewer.graph.panels.panel import GraphPanel
from gazelle.viewer.graph.statuses import Arrivals
from gazelle.viewer.sources import picture_of
from gazelle_ros import load_message

_NONE = "choose ..."
_KINDS = ("sensor_msgs/Image", "sensor_msgs/CompressedImage")
_WIDEST_PX = 640
_BELOW = 0.5  # the text before an image, in the order of the panel
_LAST = 1e8  # likewise, but for the button that closes the panel
_LIST_S = 1.0  # between two looks at what topics there are


class _TopicImages:
    """Images of one topic, with its choice, their size, encoding and rate."""

    def __init__(self, context: GraphContext, selected: str) -> None:
        self._context, self._wanted = context, selected
        self._subscriber: Any = None
        self._followed = _NONE
        self._arrivals, self._last, self._drawn = Arrivals(), None, 0
        self.image: Any = None
        gui = context.gui
        self._topic: Any = gui.add_dropdown("Topic", (_NONE,))
        self._text: Any = gui.add_markdown("")

    @property
    def topic(self) -> str:
        """Name of the topic, also of one that is not there yet; "" for none."""
        chosen: str = self._topic.value
        return self._wanted if chosen == _NONE else chosen

    def follow(self, kinds: Mapping[str, str]) -> None:
        """List topics, by name with type, and subscribe to the chosen one."""
        if tuple(self._topic.options) != (_NONE, *kinds):
            self._topic.options = (_NONE, *kinds)
        if self._wanted in kinds:
            self._topic.value, self._wanted = self._wanted, ""
        topic = self._topic.value
        if topic == self._followed and self._subscriber is not None:
            return
        self.leave()
        self._followed = topic
        if topic not in kinds:
            self._text.content = ""
        else:
            kind = load_message(kinds[topic])
            self._subscriber = self._context.node.subscribe(topic, kind, self._take, 1)

    def show(self) -> None:
        """Show the last image, if it is new."""
        if self._arrivals.count == self._drawn:
            return
        self._drawn = self._arrivals.count
        try:
            text = self._draw(self._last)
        except Error as error:
            text = str(error)
        if self._text.content != text:
            self._text.content = text

    def leave(self) -> None:
        """Unsubscribe."""
        if self._subscriber is not None:
            self._subscriber.close()
            self._subscriber = None
        self._arrivals, self._drawn = Arrivals(), 0

    def _take(self, message: Any) -> None:
        self._last = message
        self._arrivals.add()

    def _draw(self, message: Any) -> str:
        """Show an image; returns a text about it."""
        picture = picture_of(message)
        high, wide = picture.shape[:2]
        every = -(-wide // _WIDEST_PX)
        small = np.ascontiguousarray(picture[::every, ::every])
        if self.image is None:
            self.image = self._context.gui.add_image(
                small, format="jpeg", order=self._text.order + _BELOW
            )
        else:
            self.image.image = small
        encoding = getattr(message, "encoding", "") or message.format
        return f"{wide} x {high}, {encoding}, {self._arrivals.rate:.3g} Hz"


class ImageViewPanel(GraphPanel):
    """Shows the images of any number of topics.

    Args:
        context: Of the page.
    """

    title = "Image view"
    period = 0.1

    def __init__(self, context: GraphContext) -> None:
        super().__init__(context)
        self.views: list[_TopicImages] = []
        self._wanted: list[str] = []
        self._next = 0.0
        self._kinds: dict[str, str] = {}

    def build(self) -> None:
        """Add the choice of a topic, and a button for more."""
        another = self.context.gui.add_button("Another topic", order=_LAST)
        self.context.on_user_click(another, lambda: self._wanted.append(""))

    @property
    def settings(self) -> dict[str, Any]:
        """The topics, for a saved layout."""
        return {"topics": [each.topic for each in self.views]}

    def restore(self, settings: Mapping[str, Any]) -> None:
        """Show the topics of a saved layout as soon as they are there."""
        topics = settings.get("topics")
        self.use([str(each) for each in topics] if isinstance(topics, list) else [])

    def use(self, arguments: Sequence[str]) -> None:
        """Show the topics of a command line as soon as they are there."""
        shown = {each.topic for each in self.views}
        self._wanted += [each for each in arguments if each not in shown and each[:1] != "-"]

    def refresh(self) -> None:
        """List the topics, and show the last images."""
        if not self.views and not self._wanted:
            self._wanted.append("")
        self.views += [_TopicImages(self.context, topic) for topic in self._wanted]
        self._wanted.clear()
        if time.monotonic() >= self._next:
            self._next = time.monotonic() + _LIST_S
            types = self.context.node.master.topic_types()
            self._kinds = {name: kind for name, kind in sorted(types) if kind in _KINDS}
        for each in self.views:
            each.follow(self._kinds)
            each.show()

    def pause(self) -> None:
        """Unsubscribe until a page is open."""
        for each in self.views:
            each.leave()

    def close(self) -> None:
        """Unsubscribe."""
        self.pause()
