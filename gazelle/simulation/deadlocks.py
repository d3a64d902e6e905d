"""Find out that the thread that owns the state will never give it up.

A callback that is called between two steps, of a plugin or a listener, may hand work to another
thread and wait for it. If that reads the simulation, each waits for the other for ever. Where
the owner stands is the sign: the same instruction, in the waiting parts of the standard library or at
a lock, for long. Nor does a thread give it up that has ended.
"""

from __future__ import annotations

import concurrent.futures
import linecache
import queue
import re
import sys
import threading
import time
from types import FrameType

from gazelle.errors import SimulationError

# How long the owner may wait for others before those that wait for it get an error [s].
_PATIENCE = 2.0

_WAITING = (
    threading.__file__,
    queue.__file__,
    concurrent.futures.__file__.replace("__init__.py", "_base.py"),
)
"""Files whose functions stand still only to wait for other threads."""

_LOCKING = re.compile(r"\bwith\b|\.(acquire|join|wait)\(")
"""A line at which a thread waits in native code, if it does not continue from it."""


class BlockedOwner:
    """Watches where the owner of a state stands, for one that waits for it."""

    def __init__(self) -> None:
        self._place: tuple[int, int, int] | None = None
        self._since = 0.0

    def check(self, owner: int) -> None:
        """Check again for a deadlock.

        Args:
            owner: Identifier of the thread; 0 for none.

        Raises:
            SimulationError: It waits for the calling thread, has long waited for some other, or
                has ended.
        """
        frame = sys._current_frames().get(owner)  # noqa: SLF001  there is no other way to know
        if frame is None and owner and all(owner != each.ident for each in threading.enumerate()):
            raise SimulationError(
                "the simulation is blocked: a thread ended while it held the state lock",
                hint="hold the lock using 'with sim.lock:', or release what was acquired",
            )
        if frame is None or not _waits(frame):
            self._place = None
            return
        place, now = (owner, id(frame), frame.f_lasti), time.monotonic()
        if place != self._place:
            self._place, self._since = place, now
        if _joins_me(frame) or now - self._since >= _PATIENCE:
            raise SimulationError(
                f"the simulation is blocked: thread '{_name_of(owner)}' holds the state lock and "
                f"waits for another thread at {_caller(frame)}",
                hint="a callback must not wait for a thread that uses the simulation: "
                "do not wait in the callback",
            )


def _waits(frame: FrameType) -> bool:
    if frame.f_code.co_filename in _WAITING:
        return True
    # Between two lines, as at the end of a `with`, an instruction belongs to none.
    line: int | None = frame.f_lineno
    text = linecache.getline(frame.f_code.co_filename, line) if line else ""
    return _LOCKING.search(text) is not None


def _joins_me(frame: FrameType | None) -> bool:
    """Return whether a thread waits for the end of the calling one."""
    me = threading.current_thread()
    while frame is not None and frame.f_code.co_filename == threading.__file__:
        if frame.f_code.co_name == "join" and frame.f_locals.get("self") is me:
            return True
        frame = frame.f_back
    return False


def _caller(frame: FrameType) -> str:
    """Return file and line of the caller of the waiting functions."""
    here: FrameType | None = frame
    while here is not None and here.f_code.co_filename in _WAITING:
        here = here.f_back
    shown = here or frame
    return f"{shown.f_code.co_filename}:{shown.f_lineno}"


def _name_of(ident: int) -> str:
    names = {thread.ident: thread.name for thread in threading.enumerate()}
    return names.get(ident, str(ident))
