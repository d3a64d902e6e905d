"""The ROS graph that runs, live in a browser: RViz and rqt without an installed ROS."""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Sequence
from functools import partial
from typing import Any

from gazelle.viewer.graph.context import GraphContext
from gazelle.viewer.graph.display_list import DisplayList
from gazelle.viewer.graph.fitting import ViewFitter
from gazelle.viewer.graph.interactive import InteractiveServers
from gazelle.viewer.graph.layouts import LayoutControls
from gazelle.viewer.graph.panels import PanelSet
from gazelle.viewer.graph.tools import PointerTools
from gazelle.viewer.page.server import PageServer
from gazelle.viewer.page.theme import ThemeSwitch
from gazelle_ros import Node, WallClock
from gazelle_ros.base.closing import Closeable
from gazelle_ros.errors import ApiError, UnreachableError
from gazelle_ros.msgs import tf2_msgs
from gazelle_ros.tf import take_transforms

_AUTOMATIC = "automatic"
_LOOK = 1.0  # between two looks at what topics there are [s]
_PERIOD = 0.05
_GRID = (128, 128, 128)  # seen on white and on black
_SHARE = 0.2  # of a core that pictures take at most: dearer ones come less often
_log = logging.getLogger("gazelle.viewer")


class GraphView(Closeable):
    """Shows robots, frames and topics of a ROS 1 graph; also a context manager.

    Topics are subscribed while the page is open, and messages drawn twenty times per second at most.

    Args:
        master_uri: Of the master; ``ROS_MASTER_URI`` if None.
        frame: Fixed frame; the first there is of map, odom, world, base_link if None.
        port: Of the page; any free one if 0.

    Attributes:
        url: Address of the page.
        ended: Whether the graph has requested its shutdown, or it was closed.

    Raises:
        MissingExtraError: viser is not installed.
        MasterUnreachableError: There is no master.
    """

    def __init__(
        self, master_uri: str | None = None, *, frame: str | None = None, port: int = 0
    ) -> None:
        node = Node("gazelle_view", master_uri=master_uri, anonymous=True, clock=WallClock())
        try:
            server = PageServer("ROS graph", port)
        except BaseException:
            node.close()
            raise
        self.url = server.url
        self._context = context = GraphContext(
            node, server, requested_frame=(frame or "").lstrip("/")
        )
        self._stop = threading.Event()
        node.on_shutdown.append(lambda _reason: self._stop.set())
        for topic, static in (("/tf", False), ("/tf_static", True)):
            take = partial(take_transforms, context.tree, static=static)
            node.subscribe(topic, tf2_msgs.msg.TFMessage, take, 100)
        self._lay_out()
        self._thread = threading.Thread(target=self._follow, name="graph-view", daemon=True)
        self._thread.start()

    @property
    def ended(self) -> bool:
        """True once it shows nothing any more."""
        return self._stop.is_set()

    def open_panel(self, title: str, arguments: Sequence[str] = ()) -> None:
        """Open a panel on the page.

        Args:
            title: Such as ``Plot``.
            arguments: Of the rqt program that it stands for, such as fields of topics.

        Raises:
            Error: There is no such panel.
        """
        self._panels.open(title, arguments)

    def load_layout(self, name: str) -> None:
        """Show the page as it was saved under a name.

        Raises:
            Error: There is no such layout, or it cannot be read.
        """
        self._layouts.load(name)

    def close(self) -> None:
        """Leave the graph, and free the port; a second call does nothing."""
        self._stop.set()
        self._context.server.wake()
        if threading.current_thread() is not self._thread:
            self._thread.join()
        self._panels.close()
        self._context.node.close()
        self._context.server.close()

    def _lay_out(self) -> None:
        """Create everything on the page."""
        context = self._context
        gui = context.gui
        gui.main_panel.dock_right()
        context.server.light_up()
        context.page.initial_camera.position = (-4.0, -5.0, 5.0)
        context.scene.add_grid(
            "/grid", 20.0, 20.0, cell_color=_GRID, section_color=_GRID,
            cell_thickness=0.5, section_thickness=0.8, position=(0.0, 0.0, -0.01),
        )  # fmt: skip
        self._status: Any = gui.add_markdown("waiting for the graph ...")
        self._frame: Any = gui.add_dropdown("Fixed frame", (context.requested_frame or _AUTOMATIC,))
        context.on_user_change(self._frame, self._choose_frame)
        self._tools = PointerTools(context, lambda: self._displays.points)
        self._fitter = ViewFitter(context)
        context.on_user_click(
            gui.add_button("Fit view"), lambda: self._fitter.fit(self._displays.extent)
        )
        self._panels = PanelSet(context)
        self._faults: Any = gui.add_markdown("")
        self._displays = DisplayList(context)
        self._interactive = InteractiveServers(context)
        self._layouts = LayoutControls(context, self._displays, self._panels, self._fitter)
        ThemeSwitch(context.server)

    def _follow(self) -> None:
        """Draw new messages while the page is open."""
        server, look_at, draw_at = self._context.server, 0.0, 0.0
        while not self._stop.is_set():
            if not server.watched:
                self._panels.pause()
                self._displays.pause()
                server.wait()
                continue
            try:
                if time.monotonic() >= look_at:
                    look_at = time.monotonic() + _LOOK
                    self._discover()
                if time.monotonic() >= draw_at:
                    spent = time.thread_time()
                    self._picture()
                    draw_at = time.monotonic() + (time.thread_time() - spent) / _SHARE
                self._panels.refresh()
            except (ApiError, UnreachableError) as error:
                _show(self._status, f"the master does not answer: {error}")
                self._stop.wait(_LOOK)
            except Exception:  # noqa: BLE001  one failure does not end the view
                _log.exception("a picture of the graph failed")
            self._stop.wait(_PERIOD)

    def _discover(self) -> None:
        """Find new topics of the graph, and report errors."""
        displays, context = self._displays, self._context
        displays.discover()
        self._interactive.discover(dict(context.node.master.topic_types()))
        self._offer_frames()
        frames = context.tree.names()
        counts = (
            f"{len(frames)} frames, {len(displays.topics)} topics, robots: {len(displays.robots)}"
        )
        faults = [*displays.faults, *self._interactive.faults]
        _show(self._status, f"in **{context.fixed}**: {counts}")
        _show(self._faults, "\n\n".join(f"⚠ {fault}" for fault in faults))

    def _offer_frames(self) -> None:
        """List all frames in the choice of the fixed frame."""
        chosen = self._context.requested_frame
        names = sorted({*self._context.tree.names(), *([chosen] if chosen else [])})
        options = (_AUTOMATIC, *names)
        if tuple(self._frame.options) != options:
            self._frame.options = options
            self._frame.value = chosen or _AUTOMATIC

    def _choose_frame(self) -> None:
        value = self._frame.value
        self._context.requested_frame = "" if value == _AUTOMATIC else value

    def _picture(self) -> None:
        displays = self._displays
        with self._context.page.atomic():
            displays.draw()
            self._interactive.draw()
        extent = displays.extent
        if extent is not None:
            self._fitter.follow(extent, displays.shown_count)


def _show(shown: Any, text: str) -> None:
    """Show a text, if it changed."""
    if shown.content != text:
        shown.content = text
