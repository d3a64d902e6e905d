"""Write bag files, new ones or at the end of old ones, with flat memory."""

from __future__ import annotations

import contextlib
from collections.abc import Mapping
from pathlib import Path
from typing import IO

from gazelle_ros.bags import compression, records
from gazelle_ros.bags.records import U32, U64, BagIndex, Buffer, Chunk, Connection
from gazelle_ros.base.writing import naming
from gazelle_ros.clock import SECOND

CHUNK_BYTES = 768 * 1024
"""Uncompressed bytes after which a chunk is complete; as rosbag's."""


class BagWriter:
    """Writes a bag.

    Until it is closed the file has no index; what is in it can be had back by reindexing.

    Args:
        file: Open for reading and writing.
        index: Index of the existing file; empty for a new one.
        compression: ``none``, ``bz2`` or ``lz4``.
        chunk_bytes: Uncompressed bytes after which a chunk is complete.
        header_bytes: Length of the header that is in the file already.

    Attributes:
        index: Index of the written chunks, without the incomplete one.

    Raises:
        BagError: The compression is unknown.
    """

    def __init__(
        self,
        file: IO[bytes],
        index: BagIndex | None = None,
        *,
        compression: str = "none",
        chunk_bytes: int = CHUNK_BYTES,
        header_bytes: int = records.HEADER_BYTES,
    ) -> None:
        self.compression = check_compression(compression)
        self.chunk_bytes = chunk_bytes
        self.index = index or BagIndex()
        self._file = file
        self._header_bytes = header_bytes
        self._parts: list[Buffer] = []
        self._size = 0
        self._rows: dict[int, list[bytes]] = {}
        self._start = self._end = 0
        self._next_id = max(self.index.connections, default=-1) + 1
        self._safe = (0, 0)
        if index is None:
            self._file.write(records.MAGIC)
        self._write_header(0)
        self._safe = (self._file.seek(0, 2), len(self.index.chunks))

    @property
    def size(self) -> int:
        """Bytes of the file when the open chunk is written uncompressed."""
        return self._file.tell() + self._size

    def connect(self, topic: str, header: Mapping[str, str]) -> Connection:
        """Add a connection."""
        connection = Connection(self._next_id, topic, dict(header))
        self._next_id += 1
        self.index.connections[connection.id] = connection
        self._add(records.pack_connection(connection))
        return connection

    def write(self, connection: Connection, nanoseconds: int, data: Buffer) -> None:
        """Write a message that came at a time [ns]."""
        if not self._rows:
            self._start = self._end = nanoseconds
        elif nanoseconds < self._start:
            self._start = nanoseconds
        elif nanoseconds > self._end:
            self._end = nanoseconds
        seconds, rest = divmod(nanoseconds, SECOND)
        rows = self._rows.setdefault(connection.id, [])
        rows.append(records.INDEX_ENTRY.pack(seconds, rest, self._size))
        self._add(records.pack_message(connection.id, nanoseconds, data))
        self._add(data)
        if self._size > self.chunk_bytes:
            self.flush()

    def _add(self, data: Buffer) -> None:
        self._parts.append(data)
        self._size += len(data)

    def flush(self) -> None:
        """Complete the chunk and flush it to the system."""
        if self._parts:
            self._write_chunk()
        self._file.flush()
        self._safe = (self._file.tell(), len(self.index.chunks))

    def close_damaged(self, file: IO[bytes]) -> None:
        """Write the index behind the last chunk that is whole, where the rest found no room.

        Args:
            file: The same file, opened again: the buffer of the first holds what was not written.
        """
        self._file = file
        self._parts, self._size, self._rows = [], 0, {}
        end, chunks = self._safe
        del self.index.chunks[chunks:]
        file.truncate(end)
        file.seek(0, 2)
        self.close()

    def _write_chunk(self) -> None:
        content = b"".join(self._parts)
        packed = compression.compress(self.compression, content)
        position = self._file.tell()
        fields = {"compression": self.compression.encode(), "size": U32.pack(len(content))}
        self._file.write(records.pack_record(records.CHUNK, fields, packed))
        after = self._file.tell()
        for connection, rows in self._rows.items():
            head = {"ver": U32.pack(1), "conn": U32.pack(connection), "count": U32.pack(len(rows))}
            self._file.write(records.pack_record(records.INDEX, head, b"".join(rows)))
        counts = {connection: len(rows) for connection, rows in self._rows.items()}
        chunk = Chunk(position, self._start, self._end, counts, self.compression, len(packed))
        chunk.size, chunk.data = len(content), after - len(packed)
        self.index.chunks.append(chunk)
        self._parts, self._size, self._rows = [], 0, {}

    def close(self) -> None:
        """Write the index; the file stays open."""
        self.flush()
        position = self._file.tell()
        for connection in self.index.connections.values():
            self._file.write(records.pack_connection(connection))
        for chunk in self.index.chunks:
            fields = {
                "ver": U32.pack(1),
                "chunk_pos": U64.pack(chunk.position),
                "start_time": records.pack_time(chunk.start),
                "end_time": records.pack_time(chunk.end),
                "count": U32.pack(len(chunk.counts)),
            }
            data = b"".join(records.COUNT_ENTRY.pack(*each) for each in chunk.counts.items())
            self._file.write(records.pack_record(records.CHUNK_INFO, fields, data))
        self._write_header(position)
        self._file.flush()

    def _write_header(self, index_position: int) -> None:
        fields = {
            "op": bytes([records.BAG_HEADER]),
            "index_pos": U64.pack(index_position),
            "conn_count": U32.pack(len(self.index.connections)),
            "chunk_count": U32.pack(len(self.index.chunks)),
        }
        head = records.pack_header(fields)
        padding = self._header_bytes - len(head) - 4
        self._file.seek(len(records.MAGIC))
        self._file.write(head + U32.pack(padding) + b" " * padding)


def check_compression(kind: str) -> str:
    """Return the name of a compression; see `gazelle_ros.bags.compression.check`."""
    return compression.check(kind)


def open_new(path: Path, *, compression: str, chunk_bytes: int) -> tuple[IO[bytes], BagWriter]:
    """Create a bag, replacing an existing file.

    Raises:
        OSError: There is no room for its header; no file is left.
    """
    stream = path.open("w+b")
    try:
        with naming(path):
            return stream, BagWriter(stream, compression=compression, chunk_bytes=chunk_bytes)
    except OSError:
        with contextlib.suppress(OSError):
            stream.close()
        path.unlink()
        raise


def open_for_appending(
    path: Path, *, compression: str, chunk_bytes: int
) -> tuple[IO[bytes], BagWriter]:
    """Open a bag's file, cut off where its index began, and a writer that continues there.

    Raises:
        BagError: It is not a bag, or has no index.
    """
    from gazelle_ros.bags.reader import BagReader

    reader = BagReader(path)
    try:
        index, begin = reader.index, reader.begin
        for chunk in index.chunks:
            reader.file.describe(chunk)
        fields, _, _ = records.read_record(reader.file.view(), len(records.MAGIC))
        position = fields.u64("index_pos")
    finally:
        reader.close()
    file = path.open("r+b")
    file.truncate(position)
    header_bytes = begin - len(records.MAGIC)
    try:
        writer = BagWriter(
            file,
            index,
            compression=compression,
            chunk_bytes=chunk_bytes,
            header_bytes=header_bytes,
        )
    except BaseException:
        file.close()
        raise
    return file, writer
