"""One topic on the page: what it draws, where, in which style, and its status."""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

import numpy as np

from gazelle.array_types import Floats
from gazelle.errors import Error
from gazelle.rotations import rotate
from gazelle.viewer.graph import drawing as d
from gazelle.viewer.graph.context import GraphContext
from gazelle.viewer.graph.markers import draw_marker, draw_markers
from gazelle.viewer.graph.motions import KIND as MOTION
from gazelle.viewer.graph.motions import MotionTopic
from gazelle.viewer.graph.robots import DescribedRobot
from gazelle.viewer.graph.statuses import Arrivals, DisplayStatus, status_of
from gazelle.viewer.graph.styles import SIZE_LABELS, default_style
from gazelle.viewer.page.shapes import corners_around
from gazelle_ros import Subscriber, load_message
from gazelle_ros.messages import Message
from gazelle_ros.tf import TransformException

_log = logging.getLogger("gazelle.viewer")

_DRAW: dict[str, Callable[[d.Drawing, Any], None]] = {
    **d.KINDS,
    "visualization_msgs/Marker": draw_marker,
    "visualization_msgs/MarkerArray": draw_markers,
}
_EVERY = frozenset(["visualization_msgs/Marker", "visualization_msgs/MarkerArray"])
"""Types of which no message may be left out."""
KINDS = frozenset([*_DRAW, MOTION])
"""Types of message that are shown."""


class TopicDisplay:
    """Shows one topic: subscribed from its making until it is removed.

    Args:
        context: Of the page.
        topic: Its name.
        kind: Its type.
        remove: Called when a user wants it to be removed.

    Attributes:
        drawing: Its parts on the page.
        anchor: Node of the scene that they hang on, at the frame of the messages.
        shown: Whether the user wants to see it.
        frame: Of the last message.
        kind: Type of the messages.
    """

    def __init__(
        self, context: GraphContext, topic: str, kind: str, remove: Callable[[], None]
    ) -> None:
        self._context, self.topic, self.kind = context, topic, kind
        self.frame, self.unplaced, self.shown = "", "", True
        self.arrivals = Arrivals()
        self._fresh: list[Any] = []
        self._last: Any = None
        self._stale = False
        self._error = ""
        self._status = DisplayStatus("", fault=False)
        self._lock = threading.Lock()
        name = f"/topics/{topic.strip('/').replace('/', '_')}"
        self.anchor = context.scene.add_frame(name, show_axes=False)
        self.drawing = d.Drawing(context.page, name, topic, default_style(kind))
        self.motion: MotionTopic | None = None
        if kind == MOTION:
            self.motion = MotionTopic(context.scene, f"{name}/plan", topic)
        self._add_settings(remove)
        self._subscriber: Subscriber | None = None
        self.resume()

    @property
    def status(self) -> DisplayStatus:
        """Status at the last report."""
        return self._status

    @property
    def extent(self) -> Floats | None:
        """Lowest and highest corner of what is shown, in the fixed frame [m], shape (2, 3)."""
        boxes = list(self.drawing.extents.values())
        if not boxes or not self.anchor.visible:
            return None
        placed = self._in_fixed(corners_around(np.vstack(boxes)))
        return np.array([placed.min(axis=0), placed.max(axis=0)])

    @property
    def points(self) -> Floats:
        """Points of a scan or cloud that is shown, in the fixed frame [m], shape (n, 3)."""
        cloud = self.drawing.part("points")
        if cloud is None or not self.anchor.visible:
            return np.zeros((0, 3))
        return self._in_fixed(np.asarray(cloud.points, np.float64))

    def receive(self, message: Message) -> None:
        """Keep a message for the next picture; called by any thread."""
        self.arrivals.add()
        with self._lock:
            if self.kind not in _EVERY:
                self._fresh.clear()
            self._fresh.append(message)

    def resume(self) -> None:
        """Receive messages."""
        if self._subscriber is None:
            kind = load_message(self.kind)
            self._subscriber = self._context.node.subscribe(self.topic, kind, self.receive, 50)

    def pause(self) -> None:
        """Receive nothing until the next ``draw``."""
        if self._subscriber is not None:
            self._subscriber.close()
            self._subscriber = None

    def draw(self) -> None:
        """Draw the messages that are new."""
        self.resume()
        with self._lock:
            fresh, self._fresh = self._fresh, []
            stale, self._stale = self._stale, False
        if stale and self._last is not None:
            self.drawing.clear()
            fresh = fresh or [self._last]
        for message in fresh:
            self._last = message
            self._error = ""
            first = message.markers[0] if getattr(message, "markers", None) else message
            self.frame = getattr(getattr(first, "header", None), "frame_id", "").lstrip("/")
            if self.motion is not None:
                self.motion.take(message)
            else:
                self._draw(message)

    def place(self, fixed: str, robots: Mapping[str, DescribedRobot]) -> None:
        """Move it to its frame; hide it while tf does not know the frame."""
        self.unplaced = ""
        if self.frame and self.frame != fixed:
            try:
                found = self._context.tree.lookup(fixed, self.frame)
            except TransformException:
                self.anchor.visible = False
                self.unplaced = f"no transform from {self.frame} to {fixed}"
                return
            x, y, z, w = found.rotation
            self.anchor.position, self.anchor.wxyz = np.array(found.translation), (w, x, y, z)
        else:
            self.anchor.position, self.anchor.wxyz = np.zeros(3), (1.0, 0.0, 0.0, 0.0)
        self.anchor.visible = self.shown
        if self.motion is not None:
            try:
                self.motion.show(self._context.tree, fixed, robots)
            except Error as error:
                self._error = str(error)

    def report(self, offered: str, publishers: int) -> None:
        """Update the status.

        Args:
            offered: Type that the master knows for the topic.
            publishers: Number of nodes that publish on it.
        """
        self._status = status_of(
            self.arrivals, kind=self.kind, offered=offered, publishers=publishers,
            unplaced=self.unplaced, error=self._error,
        )  # fmt: skip
        label = f"{'⚠ ' * self._status.fault}{self.topic}"
        if self._folder.label != label:
            self._folder.label = label
        text = f"{self.kind}: {self._status.text}"
        if self._text.content != text:
            self._text.content = text

    @property
    def settings(self) -> dict[str, Any]:
        """Type, switch, colour and size, for a saved layout."""
        style = self.drawing.style
        color = None if style.color is None else list(style.color)
        return {"type": self.kind, "shown": self.shown, "color": color, "size": style.size}

    def restore(self, settings: Mapping[str, Any]) -> None:
        """Take the settings of a saved layout, as far as they are there."""
        self.shown = self._box.value = settings.get("shown") is not False
        color, size = settings.get("color"), settings.get("size")
        red_green_blue = tuple(color) if isinstance(color, list) and len(color) == 3 else None
        self.restyle(red_green_blue, size if isinstance(size, float) else None)

    def restyle(self, color: tuple[int, int, int] | None, size: float | None) -> None:
        """Choose colour and size, and draw the last message again; None leaves one as it is."""
        style = self.drawing.style
        for attribute, value, control in (
            ("color", color, self._color), ("size", size, self._size)
        ):  # fmt: skip
            if value is not None and control is not None:
                setattr(style, attribute, value)
                control.value = value
        with self._lock:
            self._stale = self.motion is None and self.kind not in _EVERY

    def remove(self) -> None:
        """Remove it from page and graph."""
        self.pause()
        self.drawing.clear()
        self.anchor.remove()
        self._folder.remove()

    def _in_fixed(self, points: Floats) -> Floats:
        w, x, y, z = self.anchor.wxyz
        placed: Floats = self.anchor.position + rotate(np.array([[x, y, z, w]]), points)
        return placed

    def _draw(self, message: Any) -> None:
        try:
            _DRAW[self.kind](self.drawing, message)
        except Error as error:
            self._error = str(error)
        except Exception as error:  # noqa: BLE001  one bad message does not end the view
            _log.exception("a message of %s was not drawn", self.topic)
            self._error = f"this message cannot be drawn: {error}"

    def _add_settings(self, remove: Callable[[], None]) -> None:
        gui, style = self._context.gui, self.drawing.style
        self._folder: Any = gui.add_folder(self.topic, expand_by_default=False)
        self._color: Any = None
        self._size: Any = None
        with self._folder:
            self._text: Any = gui.add_markdown(self.kind)
            self._box: Any = gui.add_checkbox("Shown", initial_value=True)
            self._box.on_update(lambda event: setattr(self, "shown", event.target.value))
            if style.color is not None:
                self._color = gui.add_rgb("Colour", initial_value=style.color)
            if style.size is not None:
                label = SIZE_LABELS[self.kind]
                self._size = gui.add_number(label, style.size, min=0.001, step=0.001)
            self._context.on_user_click(gui.add_button("Remove", color="gray"), remove)
        for control in (self._color, self._size):
            if control is not None:
                self._context.on_user_change(control, partial(self._restyle_by_user, control))

    def _restyle_by_user(self, control: Any) -> None:
        if control is self._color:
            self.restyle(control.value, None)
        else:
            self.restyle(None, control.value)
