"""A thread that waits for one busy socket, so that its messages need not pass the event loop.

Asking the system which socket is ready, and then the socket for its data, are two calls for each
message, and the second thread that a caller waits on adds more. While a socket is busy, a worker
waits for it alone; as soon as it is not, the socket goes back to the event loop. Only a few are
attended at a time: the number of threads does not grow with that of connections.
"""

from __future__ import annotations

import contextlib
import socket
import struct
import sys
import time
from collections.abc import Callable

from gazelle.ros.errors import ProtocolError, RosError
from gazelle.ros.loop import EventLoop

_USABLE = sys.platform == "linux"
"""Elsewhere a socket has no time-out of its own, or one of another form."""
_READS = 32
_BRISK_S = 0.064
"""A socket that was read `_READS` times within so many seconds is busy."""
_IDLE_S = 0.05
"""It is no longer when nothing comes for so long."""
_TIMEOUT = struct.pack("ll", 0, round(_IDLE_S * 1e6))


class Attendant:
    """Attends one socket at a time while it is busy.

    Args:
        loop: Where the socket is watched otherwise.
        step: Reads the socket, on a worker, and does what is to be done; returns whether to go
            on. It may raise OSError or RosError.
        end: Called on the leader when the socket is the loop's again, with what `step` raised.
    """

    __slots__ = ("_abandoned", "_end", "_loop", "_reads", "_since", "_step", "active")

    def __init__(
        self, loop: EventLoop, step: Callable[[], bool], end: Callable[[RosError | None], None]
    ) -> None:
        self._loop = loop
        self._step = step
        self._end = end
        self._reads = 0
        self._since = 0.0
        self._abandoned = False
        self.active = False
        """True while the socket is not the loop's."""

    def is_wanted(self) -> bool:
        """Count a read of the loop's; True if the socket is busy. Leader only."""
        self._reads += 1
        if self._reads < _READS:
            return False
        now = time.monotonic()
        brisk = now - self._since < _BRISK_S
        self._reads, self._since = 0, now
        return brisk and _USABLE and self._loop.may_attend()

    def begin(self, sock: socket.socket) -> None:
        """Attend a socket, which the loop watches no more. Leader only."""
        self.active = True
        self._abandoned = False
        self._loop.attended += 1
        sock.setblocking(True)
        sock.setsockopt(socket.SOL_SOCKET, socket.SO_RCVTIMEO, _TIMEOUT)
        self._loop.submit(lambda: self._attend(sock))

    def abandon(self, sock: socket.socket) -> None:
        """Let the thread go and close the socket; nobody needs it any more. Leader only."""
        self._abandoned = True
        with contextlib.suppress(OSError):  # the peer was faster
            sock.shutdown(socket.SHUT_RDWR)

    def _attend(self, sock: socket.socket) -> None:
        error: RosError | None = None
        step = self._step
        try:
            while not self._abandoned and step():
                pass
        except OSError as broken:
            error = ProtocolError(f"the connection broke: {broken}")
        except RosError as wrong:
            error = wrong
        finally:
            if self._abandoned:
                sock.close()
            self._loop.call_soon(lambda: self._finish(sock, error))

    def _finish(self, sock: socket.socket, error: RosError | None) -> None:
        self._loop.attended -= 1
        self.active = False
        if self._abandoned:
            sock.close()
            return
        sock.setblocking(False)
        self._end(error)
