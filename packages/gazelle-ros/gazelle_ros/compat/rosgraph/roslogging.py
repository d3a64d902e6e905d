"""Logging of ROS tools: Python's, in ROS's form on the screen, and to a file if there is one."""

from __future__ import annotations

import logging
import os
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import TextIO

LEVEL_NAMES = {
    logging.DEBUG: "DEBUG",
    logging.INFO: "INFO",
    logging.WARNING: "WARN",
    logging.ERROR: "ERROR",
    logging.CRITICAL: "FATAL",
}
_COLORS = {"WARN": "\033[33m", "ERROR": "\033[31m", "FATAL": "\033[31m", "DEBUG": "\033[32m"}
_FORMAT = "[${severity}] [${time}]: ${message}"


class RosStreamHandler(logging.Handler):
    """Writes to the screen in the form of ROSCONSOLE_FORMAT; warnings and worse to stderr.

    Args:
        colorize: Use colours on a terminal.
        stdout: In place of standard output.
        stderr: In place of standard error.
        file: Gets all records, too.
        context: Gives what the form may name beside the record: ``time`` and ``node``.
    """

    def __init__(
        self,
        colorize: bool = True,  # noqa: FBT001, FBT002  # rosgraph's interface
        stdout: TextIO | None = None,
        stderr: TextIO | None = None,
        *,
        file: logging.Handler | None = None,
        context: Callable[[], dict[str, str]] | None = None,
    ) -> None:
        super().__init__()
        self._colorize = colorize
        self._stdout = stdout
        self._stderr = stderr
        self._file = file
        self._context = context

    def emit(self, record: logging.LogRecord) -> None:
        """Write a record."""
        try:
            if self._file is not None:
                self._file.emit(record)
            severity = LEVEL_NAMES.get(record.levelno, record.levelname)
            out, err = self._stdout or sys.stdout, self._stderr or sys.stderr
            stream = err if record.levelno >= logging.WARNING else out
            if stream is None:
                return
            text = self._text(record, severity)
            color = _COLORS.get(severity, "")
            if color and self._colorize and stream.isatty():
                text = f"{color}{text}\033[0m"
            stream.write(text + "\n")
            stream.flush()
        except Exception:  # noqa: BLE001  # logging's own way to report a broken stream
            self.handleError(record)

    def _text(self, record: logging.LogRecord, severity: str) -> str:
        now = f"{time.time():f}"
        parts = {
            "severity": severity,
            "walltime": now,
            "time": now,
            "thread": str(record.thread),
            "logger": record.name,
            "file": record.pathname,
            "line": str(record.lineno),
            "function": getattr(record, "place", None) or record.funcName or "?",
            "node": "",
            **(self._context() if self._context is not None else {}),
        }
        text = os.environ.get("ROSCONSOLE_FORMAT", _FORMAT)
        for key, value in parts.items():
            text = text.replace("${" + key + "}", value)
        return text.replace("${message}", record.getMessage())


def configure_logging(
    logname: str,
    level: int = logging.INFO,
    filename: str | None = None,
    env: dict[str, str] | None = None,
) -> str | None:
    """Log to a file, if one is named or ROS_LOG_DIR is set.

    Returns:
        The file; None if there is none.
    """
    folder = (os.environ if env is None else env).get("ROS_LOG_DIR")
    if filename is None and folder:
        filename = str(Path(folder) / f"{logname}.log")
    if filename is None:
        return None
    Path(filename).parent.mkdir(parents=True, exist_ok=True)
    logging.basicConfig(filename=filename, level=level)
    return filename
