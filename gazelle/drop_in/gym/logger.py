"""gym's messages to people, through Gymnasium's."""

from __future__ import annotations

import logging

import gymnasium.logger
from gymnasium.logger import error, warn

DEBUG, INFO, WARN, ERROR = logging.DEBUG, logging.INFO, logging.WARNING, logging.ERROR
DISABLED = 50
MIN_LEVEL = WARN

__all__ = [
    "DEBUG",
    "DISABLED",
    "ERROR",
    "INFO",
    "MIN_LEVEL",
    "WARN",
    "debug",
    "error",
    "info",
    "set_level",
    "warn",
]

_log = logging.getLogger("gym")


def set_level(level: int) -> None:
    """Set the least level of messages: ``DEBUG``, ``INFO``, ``WARN``, ``ERROR``, ``DISABLED``."""
    gymnasium.logger.min_level = level
    _log.setLevel(level)


def debug(text: str, *arguments: object) -> None:
    """Log a message for debugging, with ``%`` for the arguments."""
    _log.debug(text, *arguments)


def info(text: str, *arguments: object) -> None:
    """Log a message, with ``%`` for the arguments."""
    _log.info(text, *arguments)


setLevel = set_level  # noqa: N816  # gym's older name
