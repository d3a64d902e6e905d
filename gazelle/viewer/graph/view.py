"""The ROS graph that runs, live in a browser: RViz without an installed ROS."""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np

from gazelle.errors import Error
from gazelle.viewer.graph import drawing as d
from gazelle.viewer.graph.markers import draw_marker, draw_markers
from gazelle.viewer.graph.motions import KIND as MOTION
from gazelle.viewer.graph.motions import MotionTopic
from gazelle.viewer.graph.robots import DescribedRobot
from gazelle.viewer.page.server import PageServer
from gazelle_ros import Node, WallClock, load_message
from gazelle_ros.base.closing import Closeable
from gazelle_ros.errors import ApiError, UnreachableError
from gazelle_ros.messages import Message
from gazelle_ros.msgs import tf2_msgs
from gazelle_ros.tf import FrameTree, TransformException, take_transforms

_FIXED = ("map", "odom", "world", "base_link", "base_footprint")
_LOOK = 1.0  # between two looks at what topics there are [s]
_PERIOD = 0.05
_log = logging.getLogger("gazelle.viewer")

_KINDS: dict[str, Callable[[d.Drawing, Any], None]] = {
    **d.KINDS,
    "visualization_msgs/Marker": draw_marker,
    "visualization_msgs/MarkerArray": draw_markers,
}
_EVERY = frozenset(["visualization_msgs/Marker", "visualization_msgs/MarkerArray"])
"""Kinds of which no message may be left out."""


class GraphView(Closeable):
    """Shows robots, frames and topics of a ROS 1 graph; also a context manager.

    Topics are subscribed while the page is open, and messages drawn twenty times a second at most.

    Args:
        master_uri: Of the master; ``ROS_MASTER_URI`` if None.
        frame: What stands still; the first there is of map, odom, world, base_link if None.
        port: Of the page; any free one if 0.

    Attributes:
        url: Where the page is.
        ended: Whether the graph has requested its shutdown, or it was closed.

    Raises:
        MissingExtraError: viser is not installed.
        MasterUnreachableError: There is no master.
    """

    def __init__(
        self, master_uri: str | None = None, *, frame: str | None = None, port: int = 0
    ) -> None:
        self._node = Node("gazelle_view", master_uri=master_uri, anonymous=True, clock=WallClock())
        try:
            self._server = PageServer("ROS graph", port)
        except BaseException:
            self._node.close()
            raise
        self.url, self._requested_frame = self._server.url, frame
        self._tree, self._lock = FrameTree(), threading.Lock()
        self._fresh: dict[str, list[Any]] = {}
        self._kinds: dict[str, str] = {}
        self._frames: dict[str, str] = {}
        self._drawings: dict[str, d.Drawing] = {}
        self._anchors: dict[str, Any] = {}
        self._robots: dict[str, DescribedRobot] = {}
        self._motions: dict[str, MotionTopic] = {}
        self._hidden: set[str] = set()
        self._refused: dict[str, tuple[str, str]] = {}
        self._unplaced: dict[str, str] = {}  # frames without a transform, by topic
        self._subscribers: dict[str, Any] = {}
        self._stop = threading.Event()
        self._node.on_shutdown.append(lambda _reason: self._stop.set())
        kind = tf2_msgs.msg.TFMessage
        for topic, static in (("/tf", False), ("/tf_static", True)):
            take = partial(take_transforms, self._tree, static=static)
            self._node.subscribe(topic, kind, take, 100)
        page = self._server.viser
        page.gui.main_panel.dock_right()
        self._server.light_up()
        page.initial_camera.position = (-4.0, -5.0, 5.0)
        page.scene.add_grid("/grid", 20.0, 20.0, position=(0.0, 0.0, -0.01))
        self._status = page.gui.add_markdown("waiting for the graph ...")
        self._show = page.gui.add_folder("Topics")
        self._thread = threading.Thread(target=self._follow, name="graph-view", daemon=True)
        self._thread.start()

    @property
    def ended(self) -> bool:
        """True once it shows nothing any more."""
        return self._stop.is_set()

    def close(self) -> None:
        """Leave the graph, and free the port; a second call does nothing."""
        self._stop.set()
        self._server.wake()
        if threading.current_thread() is not self._thread:
            self._thread.join()
        self._node.close()
        self._server.close()

    def _follow(self) -> None:
        """Draw new messages while the page is open."""
        looked = _LOOK
        while not self._stop.is_set():
            if not self._server.watched:
                self._server.wait()
                continue
            try:
                if looked >= _LOOK:
                    looked = 0.0
                    self._discover()
                self._picture()
            except (ApiError, UnreachableError) as error:
                self._set_status(f"the master does not answer: {error}")
                self._stop.wait(_LOOK)
            except Exception:  # noqa: BLE001  one bad message does not end the view
                _log.exception("a picture of the graph failed")
            looked += _PERIOD
            self._stop.wait(_PERIOD)

    def _set_status(self, text: str) -> None:
        if self._status.content != text:
            self._status.content = text

    def _discover(self) -> None:
        """Subscribe to topics that are new, and read robots that are."""
        for topic, kind in self._node.master.published_topics():
            if (kind in _KINDS or kind == MOTION) and topic not in self._subscribers:
                self._kinds[topic] = kind
                self._subscribers[topic] = self._node.subscribe(
                    topic, load_message(kind), partial(self._came, topic), 50
                )
        for name in self._node.param_names():
            if name.rpartition("/")[2] == "robot_description":
                self._meet(name)
        fixed = self._fixed()
        counts = f"{len(self._tree.names())} frames, {len(self._kinds)} topics"
        lines = [f"fixed frame **{fixed}** &nbsp; {counts}, {len(self._robots)} robots"]
        faults = [fault for _, fault in self._refused.values()]
        faults += [
            f"{topic}: no transform from {frame} to {fixed}, so it is not shown"
            for topic, frame in self._unplaced.items()
        ]
        faults += [
            f"{name}: no transform from any of its links to {fixed}, so it is not shown"
            for name, robot in self._robots.items()
            if not robot.placed
        ]
        self._set_status("\n\n".join([*lines, *faults]))

    def _meet(self, name: str) -> None:
        """Read a robot_description, if it is new or another one."""
        text = str(self._node.get_param(name, ""))
        known = self._robots.get(name)
        if text in (None if known is None else known.text, self._refused.get(name, ("",))[0]):
            return
        self._refused.pop(name, None)
        if known is not None:
            self._robots.pop(name).remove()
        prefix = str(self._node.get_param(f"{name.rpartition('/')[0]}/tf_prefix", "")).strip("/")
        root = f"/robots/{len(self._robots)}"
        try:
            self._robots[name] = DescribedRobot(
                self._server.viser.scene, root, text, f"{prefix}/" if prefix else ""
            )
        except Error as error:
            self._refused[name] = text, f"{name}: {error}"

    def _came(self, topic: str, message: Message) -> None:
        with self._lock:
            waiting = self._fresh.setdefault(topic, [])
            if self._kinds[topic] not in _EVERY:
                waiting.clear()
            waiting.append(message)

    def _picture(self) -> None:
        fixed = self._fixed()
        with self._lock:
            fresh, self._fresh = self._fresh, {}
        with self._server.viser.atomic():
            for topic, messages in fresh.items():
                for message in messages:
                    self._draw(topic, message)
            for topic, frame in self._frames.items():
                self._anchor(topic, fixed, frame)
            for robot in self._robots.values():
                robot.show(self._tree, fixed)
            for topic, motion in self._motions.items():
                self._move(topic, motion, fixed)

    def _move(self, topic: str, motion: MotionTopic, fixed: str) -> None:
        try:
            motion.show(self._tree, fixed, self._robots)
        except Error as error:
            self._refused[topic] = "", f"{topic}: {error}"

    def _draw(self, topic: str, message: Any) -> None:
        page, kind = self._server.viser, self._kinds[topic]
        if topic not in self._drawings:
            name = f"/topics/{topic.strip('/').replace('/', '_')}"
            self._anchors[topic] = page.scene.add_frame(name, show_axes=False)
            self._drawings[topic] = d.Drawing(page, name, topic)
            with self._show:
                box = page.gui.add_checkbox(topic, initial_value=True)
            box.on_update(partial(self._toggle, topic))
        first = message.markers[0] if getattr(message, "markers", None) else message
        self._frames[topic] = getattr(getattr(first, "header", None), "frame_id", "").lstrip("/")
        if kind != MOTION:
            _KINDS[kind](self._drawings[topic], message)
            return
        self._refused.pop(topic, None)
        if topic not in self._motions:
            name = f"{self._drawings[topic].name}/plan"
            self._motions[topic] = MotionTopic(page.scene, name, topic)
        self._motions[topic].take(message)

    def _toggle(self, topic: str, event: Any) -> None:
        (self._hidden.discard if event.target.value else self._hidden.add)(topic)

    def _anchor(self, topic: str, fixed: str, frame: str) -> None:
        """Move what a topic shows into its frame; hide it while tf does not know the frame."""
        anchor = self._anchors[topic]
        self._unplaced.pop(topic, None)
        if not frame or frame == fixed:
            anchor.visible = topic not in self._hidden
            return
        try:
            found = self._tree.lookup(fixed, frame)
        except TransformException:
            anchor.visible = False
            self._unplaced[topic] = frame
            return
        anchor.visible = topic not in self._hidden
        x, y, z, w = found.rotation
        self._anchors[topic].position = np.array(found.translation)
        self._anchors[topic].wxyz = np.array((w, x, y, z))

    def _fixed(self) -> str:
        if self._requested_frame:
            return self._requested_frame.lstrip("/")
        names = self._tree.names()
        return next((name for name in _FIXED if name in names), names[0] if names else "map")
