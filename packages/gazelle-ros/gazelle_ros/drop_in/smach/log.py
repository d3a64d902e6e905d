"""Messages of state machines, and their check for the end of the program; ``smach_ros`` sets both."""

from __future__ import annotations

import sys
from collections.abc import Callable
from typing import Any

_Logger = Callable[[str], Any]


def _written(level: str) -> _Logger:
    def write(message: str) -> None:
        sys.stdout.write(f"[{level:^7}] : {message}\n")

    return write


_loggers = {level: _written(level) for level in ("INFO", "WARN", "DEBUG", "ERROR")}
_checks: list[Callable[[], bool]] = []


def set_loggers(info: _Logger, warn: _Logger, debug: _Logger, error: _Logger) -> None:
    """Set the functions that write messages."""
    _loggers.update(INFO=info, WARN=warn, DEBUG=debug, ERROR=error)


def loginfo(msg: object) -> None:
    """Write what happens."""
    _loggers["INFO"](str(msg))


def logwarn(msg: object) -> None:
    """Write what may be wrong."""
    _loggers["WARN"](str(msg))


def logdebug(msg: object) -> None:
    """Write what authors want to know."""
    _loggers["DEBUG"](str(msg))


def logerr(msg: object) -> None:
    """Write what is wrong."""
    _loggers["ERROR"](str(msg))


def set_shutdown_check(cb: Callable[[], bool]) -> None:
    """Set a function that reports the end of the program: no more states are executed then."""
    _checks[:] = [cb]


def is_shutdown() -> bool:
    """Return True if the program ends."""
    return any(check() for check in _checks)
