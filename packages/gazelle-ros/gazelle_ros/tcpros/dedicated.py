"""A worker that reads one busy socket, so that its messages need not pass the event loop.

Querying the system for the ready socket, and then the socket for its data, are two calls for each
message, and handing it to a worker costs as much again. While a socket is busy, a worker reads it and
handles what comes; as soon as it is not, the event loop watches it again. Only a few sockets are read
so at a time: the number of threads does not grow with that of connections.
"""

from __future__ import annotations

import socket
import struct
import sys
import time
from collections.abc import Callable

from gazelle_ros.errors import ProtocolError, RosError
from gazelle_ros.loop import EventLoop

_USABLE = sys.platform == "linux"
"""Elsewhere a socket has no time-out of its own, or one of another form."""
_MOST = 4
"""Sockets read so at a time, of one process."""
_READS = 32
_BUSY_S = 0.064
"""A socket that was read `_READS` times within this number of seconds is busy."""
_IDLE_S = 0.05
"""It is no longer when nothing comes for so long."""
_TIMEOUT = struct.pack("ll", 0, round(_IDLE_S * 1e6))


class DedicatedReader:
    """Reads one socket on a worker while it is busy.

    All but `_read` runs on the event loop's thread, which alone closes the socket.

    Args:
        loop: Event loop that watches the socket otherwise.
        step: Reads the socket, on a worker, and does what is to be done; returns whether to go
            on. It may raise OSError or RosError.
        end: Called when the socket is the loop's again, with it and what `step` raised.
    """

    __slots__ = ("_end", "_loop", "_reads", "_since", "_step", "_stopped", "active")

    def __init__(
        self,
        loop: EventLoop,
        step: Callable[[], bool],
        end: Callable[[socket.socket, RosError | None], None],
    ) -> None:
        self._loop = loop
        self._step = step
        self._end = end
        self._reads = 0
        self._since = 0.0
        self._stopped = False
        self.active = False
        """True while the socket is not the loop's."""

    def is_wanted(self) -> bool:
        """Count a read of the loop's; True if the socket is busy."""
        self._reads += 1
        if self._reads < _READS:
            return False
        now = time.monotonic()
        busy = now - self._since < _BUSY_S
        self._reads, self._since = 0, now
        return busy and _USABLE and self._loop.dedicated < _MOST

    def begin(self, sock: socket.socket) -> None:
        """Start with a socket of the loop."""
        self._loop.unwatch(sock)
        self.active = True
        self._loop.dedicated += 1
        sock.setblocking(True)
        sock.setsockopt(socket.SOL_SOCKET, socket.SO_RCVTIMEO, _TIMEOUT)
        self._loop.submit(lambda: self._read(sock))

    def stop(self) -> None:
        """Read no more; a thread that waits for the socket is woken by its shutdown."""
        self._stopped = True

    def _read(self, sock: socket.socket) -> None:
        error: RosError | None = None
        step = self._step
        try:
            while not self._stopped and step():
                pass
        except OSError as broken:
            error = ProtocolError(f"the connection broke: {broken}")
        except RosError as wrong:
            error = wrong
        finally:
            self._loop.call_soon(lambda: self._return_socket(sock, error))

    def _return_socket(self, sock: socket.socket, error: RosError | None) -> None:
        self._loop.dedicated -= 1
        self.active = False
        sock.setblocking(False)
        self._end(sock, error)
