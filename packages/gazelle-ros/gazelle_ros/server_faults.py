"""Faults of servers that run in asyncio: one line each, limited in rate."""

from __future__ import annotations

import asyncio
import errno
import logging
import math
import time
from typing import Any

from gazelle_ros.errors import RosError, report
from gazelle_ros.peer_reports import PEER_REPORTS

_PAUSE_S = 10.0
"""Between two lines on missing file descriptors [s]."""
_NONE_LEFT = frozenset({errno.EMFILE, errno.ENFILE})


def report_shortages(loop: asyncio.AbstractEventLoop, what: str) -> None:
    """Report a process without free file descriptors in one line; asyncio logs a traceback a second.

    Args:
        loop: Event loop of the server.
        what: Name of the server.
    """
    said = -math.inf

    def handle(loop: asyncio.AbstractEventLoop, context: dict[str, Any]) -> None:
        nonlocal said
        error = context.get("exception")
        if not isinstance(error, OSError) or error.errno not in _NONE_LEFT:
            loop.default_exception_handler(context)
        elif time.monotonic() - said >= _PAUSE_S:
            said = time.monotonic()
            text = "this process has no free file descriptor: new connections wait"
            report(what, RosError(text, hint="raise the limit: ulimit -n 4096"))

    loop.set_exception_handler(handle)


class HandshakeFilter(logging.Filter):
    """Filter of the log of ``websockets``: failed handshakes go to the reports on peers.

    Args:
        what: Name of the server.
    """

    def __init__(self, what: str) -> None:
        super().__init__()
        self._what = what

    def filter(self, record: logging.LogRecord) -> bool:
        """Return whether a record is logged as it is."""
        from websockets.exceptions import InvalidHandshake

        error = record.exc_info[1] if record.exc_info else None
        if not isinstance(error, InvalidHandshake):
            return True
        address = getattr(getattr(record, "websocket", None), "remote_address", None)
        PEER_REPORTS.complain(self._what, str(address[0]) if address else "a peer", error)
        return False
