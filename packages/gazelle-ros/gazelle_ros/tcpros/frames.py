"""Length-prefixed frames: written, and cut out of what a socket delivers."""

from __future__ import annotations

import contextlib
import socket
import struct
import sys
from io import BytesIO
from typing import Any

from gazelle_ros.errors import ProtocolError

LENGTH = struct.Struct("<I")
CHUNK = 65536
BIG_CHUNK = 4 * 1024 * 1024
_BIG = 16384
_ROOM = b"\0\0\0\0"
_SIP = 1024 * 1024
_CAN_WAIT_FOR_MORE = sys.platform == "linux"
"""Elsewhere the low-water mark of a socket is not supported by polling."""


class ClosedError(ConnectionError):
    """The peer closed the connection."""


def frame(message: Any) -> bytes:
    """Return a message serialised, with its length before it."""
    buffer = BytesIO()
    buffer.write(_ROOM)
    message.serialize(buffer)
    length = buffer.tell() - 4
    buffer.seek(0)
    buffer.write(LENGTH.pack(length))
    return buffer.getvalue()


class FrameReader:
    """Cuts frames out of a stream.

    Args:
        limit: Longest frame, in bytes. A peer that announces a longer one is cut off before
            anything of it is stored; shorter ones are stored only as they come.
    """

    __slots__ = ("_level", "_missing", "_parts", "_rest", "limit", "received")

    def __init__(self, limit: int) -> None:
        self.limit = limit
        self.received = 0
        self._rest = b""
        self._parts: list[bytes] = []
        self._missing = 0
        self._level = 1

    def read(self, sock: socket.socket) -> list[bytes]:
        """Read available data and return complete frames, without their lengths.

        Raises:
            ClosedError: The stream ended.
            ProtocolError: A frame is longer than the limit.
            OSError: The connection broke.
        """
        missing = self._missing
        try:
            data = sock.recv(min(missing, BIG_CHUNK) if missing else CHUNK)
        except (BlockingIOError, InterruptedError):
            return []
        if not data:
            raise ClosedError("the peer closed the connection")
        self.received += len(data)
        if missing:
            frames = self._add(data)
        elif not self._rest and len(data) > 4 and LENGTH.unpack_from(data)[0] == len(data) - 4:
            return [data[4:]]  # by far the most common case
        else:
            frames = self.cut(self._rest + data if self._rest else data)
        if missing or self._missing:
            self._expect(sock)
        return frames

    def _expect(self, sock: socket.socket) -> None:
        """Request a wake-up for the rest of a big frame, rather than for each piece of it."""
        if not _CAN_WAIT_FOR_MORE:
            return
        level = max(1, min(self._missing, _SIP))
        if level != self._level:
            self._level = level
            with contextlib.suppress(OSError):
                sock.setsockopt(socket.SOL_SOCKET, socket.SO_RCVLOWAT, level)

    def cut(self, data: bytes) -> list[bytes]:
        """Return the whole frames at the start of `data`; the rest is kept for later."""
        frames: list[bytes] = []
        position, end, limit = 0, len(data), self.limit
        unpack = LENGTH.unpack_from
        while end - position >= 4:
            length: int = unpack(data, position)[0]
            if length > limit:
                raise ProtocolError(f"a message of {length} bytes exceeds the limit of {limit}")
            start = position + 4
            stop = start + length
            if stop > end:
                if length > _BIG:
                    self._rest = b""
                    self._parts = [data[start:]]
                    self._missing = stop - end
                    return frames
                break
            frames.append(data[start:stop])
            position = stop
        self._rest = data[position:]
        return frames

    def _add(self, data: bytes) -> list[bytes]:
        """Add data of a big frame, which is read by itself so that it need not be cut out."""
        self._parts.append(data)
        self._missing -= len(data)
        if self._missing:
            return []
        frame = b"".join(self._parts)
        self._parts = []
        return [frame]
