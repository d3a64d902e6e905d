"""Log of a node that is not written with rospy, on ``/rosout``: its warnings and log records."""

from __future__ import annotations

import contextlib
import logging
import sys
import threading
import warnings
from collections import deque
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any, TextIO

from gazelle_ros.base.errors import GazelleWarning
from gazelle_ros.errors import NodeClosedError
from gazelle_ros.msgs import rosgraph_msgs
from gazelle_ros.time import Time

if TYPE_CHECKING:
    from gazelle_ros.node import Node

TOPIC = "/rosout"
_ROOT = "gazelle"
_DEBUG, _INFO, _WARN, _ERROR, _FATAL = 1, 2, 4, 8, 16
_LEVELS = (
    (logging.CRITICAL, _FATAL),
    (logging.ERROR, _ERROR),
    (logging.WARNING, _WARN),
    (logging.INFO, _INFO),
)
_MOST_KEPT = 100
"""Lines that are kept for the first subscriber: rosout subscribes to a new node a moment late."""


def report_on_rosout(node: Node) -> RosoutLog | None:
    """Publish what this process warns of and logs, unless the node has ``/rosout`` already.

    Returns:
        What does it until it is closed, or the node is.
    """
    if any(each.topic == TOPIC for each in node.publications()):
        return None
    return RosoutLog(node)


class RosoutLog(logging.Handler):
    """Publishes Gazelle's warnings and the records of its loggers, under the name of a node.

    They are shown as before, too.

    Args:
        node: Publishes; continues until it is closed.
    """

    def __init__(self, node: Node) -> None:
        super().__init__()
        self._node = node
        self._kind = rosgraph_msgs.msg.Log
        self._kept: deque[Any] = deque(maxlen=_MOST_KEPT)
        self._inside = threading.local()
        self._publisher = node.advertise(TOPIC, self._kind, 100, on_connect=self._send)
        logging.getLogger(_ROOT).addHandler(self)
        _active[self] = None
        _hook()

    def close(self) -> None:
        """Publish no more."""
        if _active.pop(self, self) is self:
            return
        logging.getLogger(_ROOT).removeHandler(self)
        if not self._node.closed:
            self._publisher.close()
        _unhook()
        super().close()

    def emit(self, record: logging.LogRecord) -> None:
        """Publish a record; write it to standard error if no other logger shows it."""
        level = next((ros for least, ros in _LEVELS if record.levelno >= least), _DEBUG)
        text = record.getMessage()
        self._publish(level, text, record.filename, record.lineno, record.funcName or "")
        if record.levelno >= logging.WARNING and not _shown_elsewhere(record.name):
            sys.stderr.write(f"[{record.levelname}] {text}\n")

    def log_warning(self, text: str, file: str, line: int) -> None:
        """Publish a warning."""
        self._publish(_WARN, text, file, line, "")

    def _publish(self, level: int, text: str, file: str, line: int, function: str) -> None:
        if self._node.closed:
            self.close()
            return
        if self not in _active or getattr(self._inside, "busy", False):
            return  # what publishing has to say is not published
        self._inside.busy = True
        try:
            log = self._kind(level=level, name=self._node.name, msg=text, file=file, line=line)
            log.function = function
            log.header.stamp = Time(nsecs=self._node.clock.now())
            log.topics = [each.topic for each in self._node.publications()]
            self._kept.append(log)
            if self._publisher.has_subscribers:
                self._send()
        finally:
            self._inside.busy = False

    def _send(self, _peer: str = "") -> None:
        """Send the kept messages to the subscribers, or to the first one."""
        with contextlib.suppress(IndexError, NodeClosedError):  # another thread was faster
            while self._kept:
                self._publisher.publish(self._kept.popleft())


def _shown_elsewhere(name: str) -> bool:
    """Return whether a logger has another handler than ours."""
    logger: logging.Logger | None = logging.getLogger(name)
    while logger is not None:
        if any(not isinstance(each, RosoutLog) for each in logger.handlers):
            return True
        logger = logger.parent if logger.propagate else None
    return False


_active: dict[RosoutLog, None] = {}
_shown: Callable[..., Any] = warnings.showwarning


def _hook() -> None:
    """Replace `warnings.showwarning`, which is still called."""
    global _shown  # noqa: PLW0603  # there is one in a process
    if warnings.showwarning is not _show:
        _shown = warnings.showwarning
        warnings.showwarning = _show


def _unhook() -> None:
    if not _active and warnings.showwarning is _show:
        warnings.showwarning = _shown


def _show(
    message: Warning | str,
    category: type[Warning],
    filename: str,
    lineno: int,
    file: TextIO | None = None,
    line: str | None = None,
) -> None:
    _shown(message, category, filename, lineno, file, line)
    if issubclass(category, GazelleWarning):
        for log in list(_active):
            log.log_warning(str(message), Path(filename).name, lineno)
