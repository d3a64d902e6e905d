"""Background processes of a script: launch files and nodes that end with it."""

from __future__ import annotations

import atexit
import threading

from gazelle.clients.processes import Processes

_lock = threading.Lock()
_started: list[Processes] = []


def processes() -> Processes:
    """Return all processes that this one has started; they end with it."""
    with _lock:
        if not _started:
            _started.append(Processes())
            atexit.register(stop_all)
        return _started[0]


def stop_all() -> None:
    """Stop everything started here."""
    with _lock:
        while _started:
            _started.pop().stop_all()
