"""Look through a bag that has no index, from its beginning to where it was cut off."""

from __future__ import annotations

import contextlib
import struct
from dataclasses import dataclass, field

import numpy as np

from gazelle_ros.bags import compression, records
from gazelle_ros.bags.errors import BagFormatError
from gazelle_ros.bags.records import BagIndex, Chunk, Fields
from gazelle_ros.clock import SECOND


@dataclass(slots=True)
class BagScan:
    """Result of a scan."""

    index: BagIndex = field(default_factory=BagIndex)
    damage: str = ""
    """Why and where it ended early; empty if the whole file could be read."""


def scan(view: memoryview, position: int) -> BagScan:
    """Return all connections and messages of a bag.

    Args:
        view: The bytes of the file.
        position: Offset of the first record after the bag's header.
    """
    return _Scanner(view).run(position)


class _Scanner:
    def __init__(self, view: memoryview) -> None:
        self._view = view
        self._found = BagScan()
        self._rows: dict[int, list[tuple[int, int, int]]] = {}
        self._open: Chunk | None = None

    def run(self, position: int) -> BagScan:
        """Scan the records until the end, or until one is damaged."""
        end = len(self._view)
        while position < end:
            try:
                position = self._record(position)
            except BagFormatError as error:
                self._found.damage = error.message
                self._salvage(position)
                break
        self._close_chunk()
        return self._found

    def _record(self, position: int) -> int:
        fields, begin, end = records.read_record(self._view, position)
        if fields.op == records.CHUNK:
            self._close_chunk()
            self._chunk(position, fields, begin, end)
        elif fields.op == records.CONNECTION:
            self._connection(fields, self._view[begin:end])
        elif fields.op == records.MESSAGE:
            self._unchunked_message(fields, position, end)
        elif fields.op not in {records.INDEX, records.CHUNK_INFO, records.BAG_HEADER}:
            raise BagFormatError(f"the record at byte {position} is of no known kind")
        return end

    def _chunk(self, position: int, fields: Fields, begin: int, end: int) -> None:
        chunk = Chunk(position, 0, 0, {}, fields.text("compression"), end - begin)
        chunk.size, chunk.data = fields.u32("size"), begin
        self._open = chunk
        if begin == end:
            return  # it was being written: its records stand in the file as they are
        content = self._view[begin:end]
        if chunk.compression != compression.NONE:
            found = compression.decompress(chunk.compression, content, chunk.size)
            content = memoryview(found)
        try:
            self._content(content)
        finally:
            self._close_chunk()

    def _content(self, content: memoryview) -> None:
        """Scan the records of a chunk."""
        place = 0
        while place < len(content):
            inner, first, after = records.read_record(content, place)
            if inner.op == records.CONNECTION:
                self._connection(inner, content[first:after])
            elif inner.op == records.MESSAGE:
                self._message(inner, place)
            place = after

    def _salvage(self, position: int) -> None:
        """Read the complete part of a chunk that the end of the file cuts off."""
        with contextlib.suppress(BagFormatError, struct.error):
            (length,) = records.U32.unpack_from(self._view, position)
            after = position + 4 + length
            fields = records.unpack_fields(self._view[position + 4 : after])
            if fields.op == records.CHUNK and fields.text("compression") == compression.NONE:
                self._close_chunk()
                self._chunk(position, fields, after + 4, len(self._view))

    def _unchunked_message(self, fields: Fields, position: int, end: int) -> None:
        """Add a message of a chunk that was never finished."""
        if self._open is None:
            self._open = Chunk(position, 0, 0, {}, compression.NONE, data=position)
        chunk = self._open
        chunk.compression = compression.NONE
        chunk.compressed = chunk.size = end - chunk.data
        self._message(fields, position - chunk.data)

    def _connection(self, fields: Fields, data: memoryview) -> None:
        connection = records.connection_of(fields, data)
        self._found.index.connections.setdefault(connection.id, connection)

    def _message(self, fields: Fields, offset: int) -> None:
        seconds, nanoseconds = divmod(fields.time("time"), SECOND)
        rows = self._rows.setdefault(fields.u32("conn"), [])
        rows.append((seconds, nanoseconds, offset))

    def _close_chunk(self) -> None:
        chunk, self._open = self._open, None
        rows, self._rows = self._rows, {}
        rows = {key: each for key, each in rows.items() if key in self._found.index.connections}
        if chunk is None or not rows:
            return
        chunk.entries = {key: np.array(each, dtype=np.uint32) for key, each in rows.items()}
        chunk.counts = {key: len(each) for key, each in rows.items()}
        times = [s * SECOND + n for each in rows.values() for s, n, _ in each]
        chunk.start, chunk.end = min(times), max(times)
        self._found.index.chunks.append(chunk)
