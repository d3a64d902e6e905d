"""Levels of the loggers of nodes, as rqt_logger_level changes them."""

from __future__ import annotations

from typing import Any

from gazelle.viewer.graph.panels.panel import GraphPanel
from gazelle_ros.msgs import roscpp

_NONE = "choose ..."
_LIST = "/get_loggers"
_LEVELS = ("DEBUG", "INFO", "WARN", "ERROR", "FATAL")


class LoggerLevelPanel(GraphPanel):
    """Shows and sets the level of one logger of one node."""

    title = "Logger levels"
    period = 2.0

    def build(self) -> None:
        """Add node, logger and level."""
        gui, context = self.context.gui, self.context
        self._levels: dict[str, str] = {}
        self._node: Any = gui.add_dropdown("Node", (_NONE,))
        self._logger: Any = gui.add_dropdown("Logger", (_NONE,))
        self._level: Any = gui.add_dropdown("Level", (_NONE, *_LEVELS))
        context.on_user_change(self._node, self._read)
        context.on_user_change(self._logger, self._show)
        context.on_user_change(self._level, self._set)

    def refresh(self) -> None:
        """Update the list of nodes."""
        services = self.context.node.master.system_state()[2]
        nodes = sorted(name.removesuffix(_LIST) for name in services if name.endswith(_LIST))
        if tuple(self._node.options) != (_NONE, *nodes):
            self._node.options = (_NONE, *nodes)

    def _read(self) -> None:
        """List the loggers of the chosen node, and show the level of the chosen one."""
        node, chosen = self._node.value, self._logger.value
        self._levels = {}
        if node != _NONE:
            found = self.call(f"{node}{_LIST}", roscpp.srv.GetLoggers).loggers
            self._levels = {each.name: each.level.upper() for each in found}
        self._logger.options = (_NONE, *self._levels)
        self._logger.value = chosen if chosen in self._levels else _NONE
        self._show()

    def _show(self) -> None:
        level = self._levels.get(self._logger.value, _NONE)
        self._level.value = level if level in _LEVELS else _NONE

    def _set(self) -> None:
        """Set the chosen level, and read what the node made of it."""
        logger, level = self._logger.value, self._level.value
        if _NONE not in (self._node.value, logger, level):
            service = f"{self._node.value}/set_logger_level"
            self.call(service, roscpp.srv.SetLoggerLevel, logger=logger, level=level)
        self._read()
