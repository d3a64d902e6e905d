"""The two services on log levels that every roscpp node has."""

from __future__ import annotations

import logging
from collections.abc import Callable
from typing import Any

from gazelle_ros.errors import ServiceError
from gazelle_ros.msgs import roscpp
from gazelle_ros.node import Node

# ROS's names of levels; Python has no fatal of its own.
_LEVELS = {
    "DEBUG": logging.DEBUG,
    "INFO": logging.INFO,
    "WARN": logging.WARNING,
    "ERROR": logging.ERROR,
    "FATAL": logging.CRITICAL,
}
_NAMES = {value: name for name, value in _LEVELS.items()}


def serve_loggers(node: Node) -> Callable[[], None]:
    """Serve ``~get_loggers`` and ``~set_logger_level``; returns what ends that.

    Args:
        node: Serves.
    """
    get = roscpp.srv.GetLoggers
    change = roscpp.srv.SetLoggerLevel
    logger = roscpp.msg.Logger

    def loggers(_request: roscpp.srv.GetLoggersRequest) -> Any:
        names = logging.root.manager.loggerDict
        known = ["gazelle", *(name for name in names if name.startswith("gazelle."))]
        return {"loggers": [logger(name, _level(name)) for name in sorted(known)]}

    def set_level(request: roscpp.srv.SetLoggerLevelRequest) -> Any:
        level = _LEVELS.get(request.level.upper())
        if level is None:
            raise ServiceError(f"no such level: {request.level}")
        logging.getLogger(request.logger).setLevel(level)
        return {}

    servers = (
        node.serve("~get_loggers", get, loggers),
        node.serve("~set_logger_level", change, set_level),
    )

    def close() -> None:
        for server in servers:
            server.close()

    return close


def _level(name: str) -> str:
    value = logging.getLogger(name).getEffectiveLevel()
    return _NAMES.get(value, logging.getLevelName(value))
