"""A bag as Python sees it: the interface of ``rosbag.Bag``.

::

    with Bag("drive.bag") as bag:
        for topic, message, stamp in bag.read_messages(topics=["/scan"]):
            ...
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from io import BytesIO
from pathlib import Path
from typing import IO, Any

from gazelle_ros.bags import compression as compressions
from gazelle_ros.bags import records
from gazelle_ros.bags.answers import (
    BagMessage,
    BagMessageWithConnectionHeader,
    CompressionTuple,
    TypesAndTopicsTuple,
    compression_of,
    types_and_topics,
)
from gazelle_ros.bags.errors import BagError
from gazelle_ros.bags.limits import check_compression, check_time, chunk_bytes_of
from gazelle_ros.bags.opening import Streamed, ensure_index, header_of, raw_header
from gazelle_ros.bags.reader import BagFile, BagReader, RawBagMessage, messages_of
from gazelle_ros.bags.records import BagIndex, Connection
from gazelle_ros.bags.writer import CHUNK_BYTES, BagWriter, open_for_appending, open_new
from gazelle_ros.base.closing import Closeable
from gazelle_ros.base.writing import naming
from gazelle_ros.clock import SECOND
from gazelle_ros.time import Time
from gazelle_ros.typed import class_for

ConnectionFilter = Callable[[str, str, str, str, Mapping[str, str]], bool]
"""Takes topic, type, checksum, definition and header of a connection."""


class Compression:
    """Kinds of compression."""

    NONE = compressions.NONE
    BZ2 = compressions.BZ2
    LZ4 = compressions.LZ4


class Bag(Closeable):
    """A bag file.

    Args:
        f: Its path, or a binary stream: read from where it stands, or written to when it is closed.
        mode: ``r`` to read, ``w`` to write again, ``a`` to write at its end; all can be read from.
        compression: Of what is written: ``none``, ``bz2`` or ``lz4``.
        chunk_threshold: Uncompressed bytes after which a chunk is complete.
        allow_unindexed: Take a bag without an index too, by looking through all of it.
        options: ``compression`` and ``chunk_threshold`` as a dict.
        skip_index: Has no effect: indices are read when they are needed.

    Raises:
        BagError: It is not a bag, or damaged.
        BagUnindexedError: It has no index.
        ValueError: An argument is not valid.
        OSError: The file cannot be opened.
    """

    def __init__(
        self,
        f: str | os.PathLike[str] | IO[bytes],
        mode: str = "r",
        compression: str = Compression.NONE,
        chunk_threshold: int = CHUNK_BYTES,
        allow_unindexed: bool = False,  # noqa: FBT001, FBT002  # the signature is rosbag's
        options: Mapping[str, Any] | None = None,
        skip_index: bool = False,  # noqa: FBT001, FBT002
    ) -> None:
        del skip_index
        options = options or {}
        self._compression = str(options.get("compression", compression))
        self._chunk_threshold = chunk_bytes_of(options.get("chunk_threshold", chunk_threshold))
        check_compression(self._compression)
        if mode not in {"r", "w", "a"}:
            raise ValueError(f"mode '{mode}' is none of r, w, a")
        self.mode = mode
        self._streamed: Streamed | None = None
        if isinstance(f, (str, os.PathLike)):
            self.filename = os.fspath(f)
        else:
            self._streamed = Streamed(f, mode)
            self.filename = str(self._streamed.path)
        self._reader: BagReader | None = None
        self._writer: BagWriter | None = None
        self._stream: IO[bytes] | None = None
        self._by_topic: dict[str, Connection] = {}
        self._file: BagFile | None = None
        self._open(allow_unindexed=allow_unindexed)

    def _open(self, *, allow_unindexed: bool) -> None:
        path = Path(self.filename)
        if self.mode == "r":
            self._reader = BagReader(path, allow_unindexed=allow_unindexed)
            self._file = self._reader.file
            return
        options: dict[str, Any] = {
            "compression": self._compression,
            "chunk_bytes": self._chunk_threshold,
        }
        if self.mode == "a" and path.exists() and path.stat().st_size:
            if allow_unindexed:
                ensure_index(path)
            self._stream, self._writer = open_for_appending(path, **options)
        else:
            self._stream, self._writer = open_new(path, **options)
        self._file = BagFile(self._stream, self.filename)

    def close(self) -> None:
        """Write pending data and the index, and close the file."""
        writer, self._writer = self._writer, None
        stream, self._stream = self._stream, None
        file, self._file = self._file, None
        if file is not None:
            file.release()
        if stream is not None:
            with naming(self.filename), stream:
                if writer is not None:
                    writer.close()
        if self._reader is not None:
            self._reader.close()
            self._reader = None
        if self._streamed is not None:
            self._streamed.finish()
            self._streamed = None

    def __iter__(self) -> Iterator[BagMessage]:
        return iter(self.read_messages())

    # What is in it -------------------------------------------------------------------------

    @property
    def options(self) -> dict[str, Any]:
        """Options for writing messages."""
        return {"compression": self._compression, "chunk_threshold": self._chunk_threshold}

    @property
    def compression(self) -> str:
        """The compression of what is written; it can be set to another for what follows.

        Raises:
            ValueError: There is no such compression.
        """
        return self._compression

    @compression.setter
    def compression(self, kind: str) -> None:
        check_compression(kind)
        self.flush()
        self._compression = kind
        if self._writer is not None:
            self._writer.compression = kind

    @property
    def chunk_threshold(self) -> int:
        """Uncompressed bytes after which a chunk is complete; it can be set for what follows.

        Raises:
            ValueError: It is less than zero.
        """
        return self._chunk_threshold

    @chunk_threshold.setter
    def chunk_threshold(self, size: int) -> None:
        most_bytes = chunk_bytes_of(size)
        self.flush()
        self._chunk_threshold = most_bytes
        if self._writer is not None:
            self._writer.chunk_bytes = most_bytes

    @property
    def version(self) -> int:
        """The format: 200."""
        return 200

    @property
    def size(self) -> int:
        """Bytes of the file."""
        return len(self.stored().view())

    @property
    def index(self) -> BagIndex:
        """Connections and chunks, those written so far included."""
        if self._reader is not None:
            return self._reader.index
        if self._writer is None:
            raise ValueError("I/O operation on closed bag")
        self._writer.flush()
        return self._writer.index

    def topics(self) -> list[str]:
        """Return the topics, sorted."""
        return sorted({connection.topic for connection in self.index.connections.values()})

    def get_message_count(self, topic_filters: str | list[str] | None = None) -> int:
        """Return the number of messages, of some topics or all."""
        ids = self._ids(topic_filters)
        return sum(
            count
            for chunk in self.index.chunks
            for connection, count in chunk.counts.items()
            if ids is None or connection in ids
        )

    def get_start_time(self) -> float:
        """Return the time of the first message [s].

        Raises:
            BagError: There are none.
        """
        return min(chunk.start for chunk in self.chunks()) / SECOND

    def get_end_time(self) -> float:
        """Return the time of the last message [s].

        Raises:
            BagError: There are none.
        """
        return max(chunk.end for chunk in self.chunks()) / SECOND

    def chunks(self) -> list[records.Chunk]:
        """Return the chunks that hold messages; raise `BagError` if there are none."""
        chunks = [chunk for chunk in self.index.chunks if chunk.counts]
        if not chunks:
            raise BagError("Bag contains no message", file=self.filename)
        return chunks

    def get_type_and_topic_info(
        self, topic_filters: str | list[str] | None = None
    ) -> TypesAndTopicsTuple:
        """Return types with their checksums, and the numbers of each topic."""
        return types_and_topics(self.stored(), self.index, self._ids(topic_filters))

    def get_compression_info(self) -> CompressionTuple:
        """Return the most frequent compression, and bytes without and with it."""
        return compression_of(self.stored(), self.index, self._compression)

    # Messages ------------------------------------------------------------------------------

    def read_messages(
        self,
        topics: str | Iterable[str] | None = None,
        start_time: Any = None,
        end_time: Any = None,
        connection_filter: ConnectionFilter | None = None,
        raw: bool = False,  # noqa: FBT001, FBT002  # the signature is rosbag's
        return_connection_header: bool = False,  # noqa: FBT001, FBT002
    ) -> Iterator[Any]:
        """Yield messages in the order of time.

        Args:
            topics: Of these only.
            start_time: Not before this ``Time``.
            end_time: Not after this ``Time``.
            connection_filter: Of connections for which it is true only.
            raw: Do not decode: each message is type, bytes, checksum, place and class.
            return_connection_header: Add the header of each message's connection.

        Returns:
            `BagMessage` or `BagMessageWithConnectionHeader` objects.

        Raises:
            BagFormatError: The bag is damaged.
            RosError: A definition in the bag is malformed.
        """
        ids = self._ids(topics)
        if connection_filter is not None:
            ids = self._filtered(ids, connection_filter)
        start, end = _nanoseconds(start_time), _nanoseconds(end_time)
        for entry in messages_of(self.stored(), self.index, ids, start, end):
            message = self._raw(entry) if raw else self._decoded(entry)
            seconds, nanoseconds = divmod(entry.time, SECOND)
            topic, stamp = entry.connection.topic, Time(seconds, nanoseconds)
            if return_connection_header:
                header = entry.connection.header
                yield BagMessageWithConnectionHeader(topic, message, stamp, header)
            else:
                yield BagMessage(topic, message, stamp)

    @staticmethod
    def _decoded(entry: RawBagMessage) -> Any:
        return class_for(entry.connection.header)().deserialize(entry.data)

    @staticmethod
    def _raw(entry: RawBagMessage) -> tuple[str, bytes, str, tuple[int, int], Any]:
        connection = entry.connection
        kind = class_for(connection.header)
        return connection.type, entry.data, connection.md5sum, entry.place, kind

    def _ids(self, topics: str | Iterable[str] | None) -> set[int] | None:
        """Return the connections of topics, with or without a slash before their names."""
        if topics is None:
            return None
        names = {topics} if isinstance(topics, str) else set(topics)
        plain = {topic.lstrip("/") for topic in names}
        connections = self.index.connections.values()
        return {each.id for each in connections if each.topic.lstrip("/") in plain}

    def _filtered(self, connections: set[int] | None, keep: ConnectionFilter) -> set[int]:
        return {
            each.id
            for each in self.index.connections.values()
            if (connections is None or each.id in connections)
            and keep(
                each.topic,
                each.type,
                each.md5sum,
                each.header.get("message_definition", ""),
                each.header,
            )
        }

    # Writing -------------------------------------------------------------------------------

    def write(
        self,
        topic: str,
        msg: Any,
        t: Any = None,
        raw: bool = False,  # noqa: FBT001, FBT002  # the signature is rosbag's
        connection_header: Mapping[str, str] | None = None,
    ) -> None:
        """Write a message.

        Args:
            topic: Its topic.
            msg: The message; raw, a tuple of type, bytes, checksum, class, with or without a
                place before the class.
            t: Time of arrival, a ``Time``; by default now.
            raw: The message is such a tuple.
            connection_header: Of the connection, if this is the topic's first message.

        Raises:
            ValueError: The bag is closed, or an argument is not valid.
            BagError: The bag is open for reading only, or a raw message has no definition.
            SerializationError: A field has a value of the wrong type.
            OSError: There is no room; what was written before stays.
        """
        if self._writer is None:
            if self._reader is None:
                raise ValueError("I/O operation on closed bag")
            raise BagError("the bag is open for reading only", hint="open it with mode 'w' or 'a'")
        if not topic or msg is None:
            raise ValueError("topic is invalid" if not topic else "msg is invalid")
        stamp = time.time_ns() if t is None else t.to_nsec()
        check_time(stamp)
        connection = self._by_topic.get(topic)
        if connection is None:
            header = raw_header(msg) if raw else header_of(msg)
            if connection_header is not None:
                header |= {str(key): str(value) for key, value in connection_header.items()}
            header["topic"] = topic
            with naming(self.filename):
                connection = self._by_topic[topic] = self._writer.connect(topic, header)
        if raw:
            data = msg[1]
        else:
            buffer = BytesIO()
            msg.serialize(buffer)
            data = buffer.getvalue()
        with naming(self.filename):
            self._writer.write(connection, stamp, data)

    def reindex(self) -> Iterator[int]:
        """Return the places of all chunks; a bag without an index got one when it was opened."""
        return iter([chunk.position for chunk in self.index.chunks])

    def flush(self) -> None:
        """Flush written data to the operating system."""
        if self._writer is not None:
            with naming(self.filename):
                self._writer.flush()

    def __str__(self) -> str:
        from gazelle_ros.bags.info import describe

        return describe(self)

    def stored(self) -> BagFile:
        """Return the file on disk, with everything written so far."""
        if self._file is None:
            raise ValueError("I/O operation on closed bag")
        self.flush()
        return self._file


def _nanoseconds(stamp: Any) -> int | None:
    return None if stamp is None else int(stamp.to_nsec())
