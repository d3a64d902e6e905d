"""rospy's log functions: to the screen, to /rosout, to a file."""

from __future__ import annotations

import contextlib
import logging
import os
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from gazelle_ros.base.writing import naming
from gazelle_ros.compat.rosgraph.roslogging import LEVEL_NAMES, RosStreamHandler
from gazelle_ros.compat.rospy import names
from gazelle_ros.compat.rospy.rostime import (
    Time,
    get_rostime,
    get_time,
    is_rostime_initialized,
    is_wallclock,
)
from gazelle_ros.compat.rospy.state import process
from gazelle_ros.msgs import rosgraph_msgs

DEBUG, INFO, WARN, ERROR, FATAL = 1, 2, 4, 8, 16
__all__ = [
    "DEBUG",
    "ERROR",
    "FATAL",
    "INFO",
    "WARN",
    "logdebug",
    "logdebug_once",
    "logdebug_throttle",
    "logdebug_throttle_identical",
    "logerr",
    "logerr_once",
    "logerr_throttle",
    "logerr_throttle_identical",
    "logerror",
    "logfatal",
    "logfatal_once",
    "logfatal_throttle",
    "logfatal_throttle_identical",
    "loginfo",
    "loginfo_once",
    "loginfo_throttle",
    "loginfo_throttle_identical",
    "logout",
    "logwarn",
    "logwarn_once",
    "logwarn_throttle",
    "logwarn_throttle_identical",
]

LEVELS = {DEBUG: logging.DEBUG, INFO: logging.INFO, WARN: logging.WARNING}
LEVELS |= {ERROR: logging.ERROR, FATAL: logging.CRITICAL}
"""Levels of ROS, and those of Python's logging."""
_HERE = os.path.dirname(__file__)  # noqa: PTH120  # compared with code objects' names

logger = logging.getLogger("rosout")


def level_of(record: logging.LogRecord) -> int:
    """Return the level of ROS of a log record."""
    for level in (FATAL, ERROR, WARN, INFO):
        if record.levelno >= LEVELS[level]:
            return level
    return DEBUG


def _context() -> dict[str, str]:
    """Return the values of this process for a log line's format."""
    moment = f"{time.time():f}"
    if is_rostime_initialized() and not is_wallclock():
        moment += f", {get_time():f}"
    return {"time": moment, "node": names.get_caller_id()}


class RosOutHandler(logging.Handler):
    """Publishes on /rosout."""

    def __init__(self) -> None:
        super().__init__()
        self._busy = False

    def emit(self, record: logging.LogRecord) -> None:
        """Publish a record."""
        node = process.node
        if self._busy or node is None or node.closed or _publisher is None:
            return
        self._busy = True
        try:
            log = rosgraph_msgs.msg.Log(
                level=level_of(record),
                name=names.get_caller_id(),
                msg=record.getMessage(),
                file=record.filename,
                line=record.lineno,
                function=getattr(record, "place", None) or record.funcName or "?",
                topics=[publication.topic for publication in node.publications()],
            )
            log.header.stamp = get_rostime()
            _publisher.publish(log)
        except Exception:  # noqa: BLE001  # a log must not stop what logs
            self.handleError(record)
        finally:
            self._busy = False


_publisher: Any = None


def start_screen(level: int | None) -> None:
    """Log to the screen, and to a file if the command line or ROS_LOG_DIR names one."""
    logger.setLevel(LEVELS.get(level or INFO, logging.INFO))
    logger.propagate = False
    if not any(isinstance(handler, RosStreamHandler) for handler in logger.handlers):
        screen = RosStreamHandler(file=_file_handler(), context=_context)
        logger.addHandler(screen)
        logging.getLogger("gazelle.ros").addHandler(screen)


class _LogFile(logging.FileHandler):
    """A file of log lines; without room it ends, with one line on the screen."""

    def emit(self, record: logging.LogRecord) -> None:
        """Write a line."""
        try:
            with naming(self.baseFilename):
                self.stream = self.stream or self._open()
                self.stream.write(self.format(record) + self.terminator)
                self.stream.flush()
        except OSError as error:
            self._end(error)

    def _end(self, error: OSError) -> None:
        self.setLevel(logging.CRITICAL + 1)
        stream, self.stream = self.stream, None
        if stream is not None:
            with contextlib.suppress(OSError):
                stream.close()
        sys.stderr.write(f"the log ends: {error.filename}: {error.strerror}\n")


def _file_handler() -> logging.Handler | None:
    path = _log_path()
    if path is None:
        return None
    path.parent.mkdir(parents=True, exist_ok=True)
    handler = _LogFile(path, encoding="utf-8", delay=True)
    line = "[%(name)s][%(levelname)s] %(asctime)s: %(message)s"
    handler.setFormatter(logging.Formatter(line))
    return handler


def _log_path() -> Path | None:
    named = names.get_mappings().get("__log")
    if named:
        return Path(named)
    folder = os.environ.get("ROS_LOG_DIR")
    if not folder:
        return None
    return Path(folder) / (names.get_caller_id().strip("/").replace("/", "-") + ".log")


def start_rosout() -> None:
    """Log to /rosout."""
    global _publisher  # noqa: PLW0603  # there is one node a process
    kind = rosgraph_msgs.msg.Log
    _publisher = process.require().advertise("/rosout", kind, queue_size=100, latch=True)
    logger.addHandler(RosOutHandler())


def stop() -> None:
    """Stop what was started."""
    global _publisher  # noqa: PLW0603  # there is one node a process
    _publisher = None
    for handler in list(logger.handlers):
        logger.removeHandler(handler)
        handler.close()
    system = logging.getLogger("gazelle.ros")
    for handler in list(system.handlers):
        if isinstance(handler, RosStreamHandler):
            system.removeHandler(handler)


# The functions -----------------------------------------------------------------------------------

_seen: set[Any] = set()
_when: dict[Any, Time] = {}
_last: dict[Any, str] = {}
Log = Callable[..., None]


def _caller() -> Any:
    """Return the position of the log function's caller: file, line and last instruction."""
    frame = sys._getframe(2)  # noqa: SLF001  # the only way to distinguish call sites
    while frame.f_back is not None and frame.f_code.co_filename.startswith(_HERE):
        frame = frame.f_back
    return frame.f_code.co_filename, frame.f_lineno, frame.f_lasti


def _due(site: Any, period: float) -> bool:
    """Return whether the period since the last time at this place is over."""
    now = get_rostime() if is_rostime_initialized() else Time.from_sec(time.time())
    before = _when.get(site)
    # After a jump back of simulated time, the count starts again.
    if before is not None and before <= now and (now - before).to_sec() < period:
        return False
    _when[site] = now
    return True


def _write(level: int, msg: Any, args: tuple[Any, ...], kwargs: dict[str, Any]) -> None:
    name = kwargs.pop("logger_name", None)
    target = logging.getLogger(f"rosout.{name}") if name else logger
    kwargs.setdefault("stacklevel", 3)
    code = sys._getframe(2).f_code  # noqa: SLF001  # the line that logs
    if "<" not in code.co_qualname:
        kwargs["extra"] = {"place": code.co_qualname, **kwargs.get("extra", {})}
    if not logger.handlers and process.node is None:
        sys.stderr.write(f"[{LEVEL_NAMES[level]}] {msg % args if args else msg}\n")
        return
    target.log(level, msg, *args, **kwargs)


def _family(level: int) -> tuple[Log, Log, Log, Log]:
    """Return the log functions of a level: plain, once, throttled, throttled when identical."""

    def plain(msg: Any, *args: Any, **kwargs: Any) -> None:
        _write(level, msg, args, kwargs)

    def once(msg: Any, *args: Any, **kwargs: Any) -> None:
        site = _caller()
        if site not in _seen:
            _seen.add(site)
            _write(level, msg, args, kwargs)

    def throttle(period: float, msg: Any, *args: Any, **kwargs: Any) -> None:
        if _due(_caller(), period):
            _write(level, msg, args, kwargs)

    def identical(period: float, msg: Any, *args: Any, **kwargs: Any) -> None:
        site, text = _caller(), str(msg)
        changed = _last.get(site) != text
        if changed:
            _when.pop(site, None)
        if _due(site, period) or changed:
            _last[site] = text
            _write(level, msg, args, kwargs)

    word = {"WARN": "warn", "ERROR": "err"}.get(LEVEL_NAMES[level], LEVEL_NAMES[level].lower())
    for function, suffix in (
        (plain, ""),
        (once, "_once"),
        (throttle, "_throttle"),
        (identical, "_throttle_identical"),
    ):
        function.__name__ = function.__qualname__ = f"log{word}{suffix}"
        function.__doc__ = f"Log at level {LEVEL_NAMES[level]}; `msg` may have % places for `args`."
    return plain, once, throttle, identical


logdebug, logdebug_once, logdebug_throttle, logdebug_throttle_identical = _family(logging.DEBUG)
loginfo, loginfo_once, loginfo_throttle, loginfo_throttle_identical = _family(logging.INFO)
logwarn, logwarn_once, logwarn_throttle, logwarn_throttle_identical = _family(logging.WARNING)
logerr, logerr_once, logerr_throttle, logerr_throttle_identical = _family(logging.ERROR)
logfatal, logfatal_once, logfatal_throttle, logfatal_throttle_identical = _family(logging.CRITICAL)
logerror = logerr
logout = loginfo
