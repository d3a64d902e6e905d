"""Read bag files: their index, and messages in the order of time."""

from __future__ import annotations

import contextlib
import mmap
from collections import OrderedDict
from collections.abc import Collection, Iterator
from pathlib import Path
from typing import IO, Any, NamedTuple

import numpy as np

from gazelle_ros.bags import compression, records
from gazelle_ros.bags.errors import BagFormatError, BagUnindexedError
from gazelle_ros.bags.records import BagIndex, Chunk, Connection
from gazelle_ros.clock import SECOND

_CACHED_CHUNKS = 8
_BLOCK = 65536


class RawBagMessage(NamedTuple):
    """A message in a bag, as bytes."""

    connection: Connection
    time: int
    """When it was received [ns]."""
    data: bytes
    place: tuple[int, int]
    """Position of its chunk in the file, and its own in the chunk."""


class BagFile:
    """The bytes of a bag, and its chunks.

    Args:
        file: Open for reading; it may grow.
        name: For errors.
    """

    def __init__(self, file: IO[bytes], name: str) -> None:
        self._file = file
        self.name = name
        self._map: mmap.mmap | None = None
        self._view = memoryview(b"")
        self._chunks: OrderedDict[int, memoryview] = OrderedDict()

    def view(self) -> memoryview:
        """Return all bytes of the file as it is now."""
        size = self._file.seek(0, 2)
        if len(self._view) != size:
            self.release()
            if size:
                self._map = mmap.mmap(self._file.fileno(), size, access=mmap.ACCESS_READ)
                self._view = memoryview(self._map)
        return self._view

    def release(self) -> None:
        """Release the file's bytes."""
        self._chunks.clear()
        view, self._view = self._view, memoryview(b"")
        mapped, self._map = self._map, None
        # A reader of messages keeps the bytes until it is done.
        with contextlib.suppress(BufferError):
            view.release()
            if mapped is not None:
                mapped.close()

    def describe(self, chunk: Chunk) -> None:
        """Look up a chunk's compression, size and place.

        Raises:
            BagFormatError: There is no chunk where it should be.
        """
        if chunk.data >= 0:
            return
        fields, begin, end = records.read_record(self.view(), chunk.position)
        if fields.op != records.CHUNK:
            raise BagFormatError(f"there is no chunk at byte {chunk.position}", file=self.name)
        chunk.compression = fields.text("compression")
        chunk.size = fields.u32("size")
        chunk.data, chunk.compressed = begin, end - begin

    def content(self, chunk: Chunk) -> memoryview:
        """Return the records of a chunk.

        Raises:
            BagFormatError: It is damaged.
        """
        view = self.view()
        found = self._chunks.get(chunk.position)
        if found is not None:
            self._chunks.move_to_end(chunk.position)
            return found
        self.describe(chunk)
        found = view[chunk.data : chunk.data + chunk.compressed]
        if chunk.compression != compression.NONE:
            found = memoryview(compression.decompress(chunk.compression, found, chunk.size))
        self._chunks[chunk.position] = found
        if len(self._chunks) > _CACHED_CHUNKS:
            self._chunks.popitem(last=False)
        return found

    def entries(self, chunk: Chunk) -> dict[int, Any]:
        """Return seconds, nanoseconds and position of each message, shape (n, 3), by connection.

        Raises:
            BagFormatError: The chunk's index is damaged.
        """
        if chunk.entries is not None:
            return chunk.entries
        self.describe(chunk)
        view, position = self.view(), chunk.data + chunk.compressed
        found: dict[int, Any] = {}
        for _ in chunk.counts:
            fields, begin, end = records.read_record(view, position)
            if fields.op != records.INDEX or (end - begin) % 12:
                raise BagFormatError(f"the index at byte {position} is damaged", file=self.name)
            rows = np.frombuffer(bytes(view[begin:end]), dtype="<u4").reshape(-1, 3)
            found[fields.u32("conn")] = rows
            position = end
        return found


class BagReader:
    """Reads a bag.

    Args:
        path: The file.
        allow_unindexed: Look through a bag without an index instead of refusing it.

    Attributes:
        index: Index of the bag.
        begin: Offset of the first record after the header.

    Raises:
        BagFormatError: It is not a bag, or damaged.
        BagUnindexedError: It has no index.
        OSError: It cannot be read.
    """

    def __init__(self, path: str | Path, *, allow_unindexed: bool = False) -> None:
        self.path = str(path)
        self._stream: IO[bytes] = Path(path).open("rb")  # noqa: SIM115  # close() closes it
        self.file = BagFile(self._stream, self.path)
        self.begin = 0
        try:
            self.index = self._read_index(allow_unindexed=allow_unindexed)
        except BagFormatError as error:
            self.close()
            raise BagFormatError(error.message, file=self.path, hint=error.hint) from None
        except BaseException:
            self.close()
            raise

    def close(self) -> None:
        """Close the file."""
        self.file.release()
        self._stream.close()

    def messages(
        self,
        connections: Collection[int] | None = None,
        start: int | None = None,
        end: int | None = None,
    ) -> Iterator[RawBagMessage]:
        """Yield messages in the order of time; see `messages_of`."""
        return messages_of(self.file, self.index, connections, start, end)

    def _read_index(self, *, allow_unindexed: bool) -> BagIndex:
        view = self.file.view()
        position = check_magic(view)
        fields, _, after = records.read_record(view, position)
        if fields.op != records.BAG_HEADER:
            raise BagFormatError("the bag has no header")
        self.begin = after
        if fields.text("encryptor"):
            raise BagFormatError(f"the bag is encrypted by {fields.text('encryptor')}")
        if fields.u64("index_pos") == 0:
            if allow_unindexed:
                from gazelle_ros.bags.scanning import scan

                return scan(view, after).index
            raise BagUnindexedError(self.path)
        return _read_tail(view, fields)


def check_magic(view: memoryview) -> int:
    """Return the offset of the first record.

    Raises:
        BagFormatError: It is not a bag of format 2.0.
    """
    begin = bytes(view[: len(records.MAGIC)])
    if begin == records.MAGIC:
        return len(records.MAGIC)
    if begin.startswith(b"#ROSBAG V"):
        version = begin[9:].decode(errors="replace").strip()
        raise BagFormatError(
            f"bags of format {version} are not read, only 2.0",
            hint="convert it with the 'rosbag fix' of an old ROS",
        )
    raise BagFormatError("this is not a bag: it does not begin with '#ROSBAG V2.0'")


def _read_tail(view: memoryview, header: records.Fields) -> BagIndex:
    """Read connections and chunks from the end of the file."""
    index, position = BagIndex(), header.u64("index_pos")
    for _ in range(header.u32("conn_count")):
        fields, begin, end = records.read_record(view, position)
        if fields.op != records.CONNECTION:
            raise BagFormatError(f"there is no connection at byte {position}")
        connection = records.connection_of(fields, view[begin:end])
        index.connections[connection.id] = connection
        position = end
    for _ in range(header.u32("chunk_count")):
        fields, begin, end = records.read_record(view, position)
        if fields.op != records.CHUNK_INFO or (end - begin) % 8:
            raise BagFormatError(f"there is no description of a chunk at byte {position}")
        counts = dict(records.COUNT_ENTRY.iter_unpack(view[begin:end]))
        start, stop = fields.time("start_time"), fields.time("end_time")
        index.chunks.append(Chunk(fields.u64("chunk_pos"), start, stop, counts))
        position = end
    return index


def select(
    file: BagFile,
    index: BagIndex,
    connections: frozenset[int] | None,
    start: int | None,
    end: int | None,
) -> tuple[Any, Any, Any, Any]:
    """Select messages in the order of time, as arrays of equal length.

    Returns:
        Times [ns], connections, numbers of chunks, positions in them.
    """
    columns: list[tuple[Any, Any, Any, Any]] = []
    for number, chunk in enumerate(index.chunks):
        if connections is not None and connections.isdisjoint(chunk.counts):
            continue
        if (start is not None and chunk.end < start) or (end is not None and chunk.start > end):
            continue
        for connection, rows in file.entries(chunk).items():
            if connection not in index.connections:
                raise BagFormatError(f"there is no connection {connection}", file=file.name)
            if connections is not None and connection not in connections:
                continue
            times = rows[:, 0].astype(np.int64) * SECOND + rows[:, 1]
            ids = np.full(len(rows), connection, np.int64)
            columns.append((times, ids, np.full(len(rows), number, np.int64), rows[:, 2]))
    if not columns:
        empty = np.empty(0, np.int64)
        return empty, empty, empty, empty
    times, ids, chunks, offsets = (np.concatenate(part) for part in zip(*columns, strict=True))
    keep = np.ones(len(times), bool)
    if start is not None:
        keep &= times >= start
    if end is not None:
        keep &= times <= end
    order = np.lexsort((offsets, chunks, times))
    order = order[keep[order]]
    return times[order], ids[order], chunks[order], offsets[order]


def messages_of(
    file: BagFile,
    index: BagIndex,
    connections: Collection[int] | None = None,
    start: int | None = None,
    end: int | None = None,
) -> Iterator[RawBagMessage]:
    """Yield messages in the order of time, and in that of the file where times are equal.

    Args:
        file: The bag's bytes.
        index: Index of the bag.
        connections: Of these only.
        start: Not before this time [ns].
        end: Not after this time [ns].

    Raises:
        BagFormatError: The bag is damaged.
    """
    selected = None if connections is None else frozenset(connections)
    times, ids, chunks, offsets = select(file, index, selected, start, end)
    for begin in range(0, len(times), _BLOCK):
        part = slice(begin, begin + _BLOCK)
        current, content = -1, memoryview(b"")
        rows = zip(
            times[part].tolist(),
            ids[part].tolist(),
            chunks[part].tolist(),
            offsets[part].tolist(),
            strict=True,
        )
        for time, connection, number, offset in rows:
            if number != current:
                current, content = number, file.content(index.chunks[number])
            first, last = records.message_at(content, offset)
            yield RawBagMessage(
                index.connections[connection],
                time,
                bytes(content[first:last]),
                (index.chunks[number].position, offset),
            )
