"""Panels that are open, beside each other on the page."""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from gazelle.errors import Error, did_you_mean
from gazelle.viewer.graph.context import GraphContext
from gazelle.viewer.graph.panels.panel import GraphPanel
from gazelle.viewer.graph.panels.table import PANELS
from gazelle_ros.errors import ApiError, UnreachableError

_NONE = "choose ..."
_WIDTH_PX = 460
_log = logging.getLogger("gazelle.viewer")


@dataclass
class _OpenPanel:
    """A panel on the page, its window there, and when it was refreshed."""

    panel: GraphPanel
    window: Any
    tab: Any
    refreshed: float = 0.0


class PanelSet:
    """Opens and closes panels for users, and refreshes those that are open.

    Args:
        context: Of the page.
    """

    def __init__(self, context: GraphContext) -> None:
        self._context = context
        self._lock = threading.Lock()
        self._requests: list[Callable[[], None]] = []
        self._open: dict[str, _OpenPanel] = {}
        self._choice: Any = context.gui.add_dropdown("Open panel", (_NONE, *PANELS))
        context.on_user_change(self._choice, self._choose)

    @property
    def titles(self) -> list[str]:
        """Titles of the open panels."""
        return list(self._open)

    def panel(self, title: str) -> GraphPanel | None:
        """Return an open panel, or None."""
        found = self._open.get(title)
        return None if found is None else found.panel

    def open(
        self, title: str, arguments: Sequence[str] = (), settings: dict[str, Any] | None = None
    ) -> None:
        """Open a panel with the next picture, if it is not open yet.

        Args:
            title: Of the panel.
            arguments: Of the rqt program that it stands for.
            settings: Of a saved layout.

        Raises:
            Error: There is no such panel.
        """
        if title not in PANELS:
            raise Error(f"there is no panel '{title}'", hint=did_you_mean(title, PANELS))
        with self._lock:
            self._requests.append(lambda: self._make(title, arguments, settings or {}))

    @property
    def settings(self) -> dict[str, dict[str, Any]]:
        """Settings of the open panels, for a saved layout."""
        return {title: each.panel.settings for title, each in self._open.items()}

    def restore(self, settings: Mapping[str, Any]) -> None:
        """Open the panels of a saved layout, and close all others."""
        for title in set(self._open) - set(settings):
            self.close_panel(title)
        for title, each in settings.items():
            if title in PANELS and isinstance(each, dict):
                self.open(title, settings=each)

    def close_panel(self, title: str) -> None:
        """Close a panel with the next picture."""
        with self._lock:
            self._requests.append(lambda: self._remove(title))

    def refresh(self) -> None:
        """Open and close requested panels, and refresh those that are due."""
        with self._lock:
            requests, self._requests = self._requests, []
        for request in requests:
            request()
        now = time.monotonic()
        for title, each in tuple(self._open.items()):
            if now - each.refreshed >= each.panel.period:
                each.refreshed = now
                self._refresh(title, each)

    def pause(self) -> None:
        """Leave the graph alone while no page is open."""
        for each in self._open.values():
            each.panel.pause()

    def close(self) -> None:
        """Close all panels' connections."""
        for each in self._open.values():
            each.panel.close()

    def _refresh(self, title: str, each: _OpenPanel) -> None:
        try:
            with each.tab:
                each.panel.refresh()
        except (ApiError, UnreachableError):
            raise
        except Error as error:
            self._context.notify(title, str(error))
        except Exception:  # noqa: BLE001  one panel does not end the others
            _log.exception("the panel %s failed", title)

    def _choose(self) -> None:
        title = self._choice.value
        if title != _NONE:
            self._choice.value = _NONE
            self.open(title)

    def _make(self, title: str, arguments: Sequence[str], settings: dict[str, Any]) -> None:
        if title not in self._open:
            gui = self._context.gui
            window = gui.add_panel()
            tab = window.add_tab(title)
            panel = PANELS[title](self._context)
            with tab:
                panel.build()
                button = gui.add_button("Close", color="gray", order=1e9)
            self._context.on_user_click(button, lambda: self.close_panel(title))
            last = next(reversed(self._open.values()), None)
            if last is None:
                window.dock_left()
            else:
                window.dock_below(last.window)
            window.set_width(_WIDTH_PX)
            self._open[title] = _OpenPanel(panel, window, tab)
        panel = self._open[title].panel
        panel.restore(settings)
        if arguments:
            panel.use(arguments)

    def _remove(self, title: str) -> None:
        closed = self._open.pop(title, None)
        if closed is not None:
            closed.panel.close()
            closed.window.remove()
