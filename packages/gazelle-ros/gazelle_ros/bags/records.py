"""The records of bag files, format 2.0 (http://wiki.ros.org/Bags/Format/2.0), and their parts."""

from __future__ import annotations

import struct
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from gazelle_ros.bags.errors import BagFormatError
from gazelle_ros.clock import SECOND

MAGIC = b"#ROSBAG V2.0\n"
MESSAGE, BAG_HEADER, INDEX, CHUNK, CHUNK_INFO, CONNECTION = 2, 3, 4, 5, 6, 7
HEADER_BYTES = 4104
"""Length of the padded bag header, which is written again when the bag is closed.

Rosbag's own length: a program that appends with another length overwrites the first chunk."""

U32 = struct.Struct("<I")
U64 = struct.Struct("<Q")
TIME = struct.Struct("<II")
INDEX_ENTRY = struct.Struct("<III")
COUNT_ENTRY = struct.Struct("<II")

# A message's record: header length, then op, conn and time, each with its length; data length.
_MESSAGE = struct.Struct("<I I4s I5sI I5sII I")
_MESSAGE_HEADER = 38

Buffer = bytes | memoryview


@dataclass(slots=True)
class Connection:
    """Source of messages: a topic of a node."""

    id: int
    topic: str
    header: dict[str, str]
    """Its fields ``type``, ``md5sum``, ``message_definition``, and often ``callerid``, ``latching``."""

    @property
    def type(self) -> str:
        """The type of its messages."""
        return self.header.get("type", "")

    @property
    def md5sum(self) -> str:
        """The checksum of the type."""
        return self.header.get("md5sum", "")


@dataclass(slots=True)
class Chunk:
    """A block of messages. Times are in nanoseconds."""

    position: int
    """Offset of its record in the file."""
    start: int
    end: int
    counts: dict[int, int]
    """Messages by connection."""
    compression: str = ""
    compressed: int = 0
    """Bytes in the file."""
    size: int = 0
    """Bytes of its records."""
    data: int = -1
    """Offset of its data in the file; -1 until that is looked up."""
    entries: dict[int, Any] | None = None
    """Time and place of the messages by connection, for a chunk without index records."""


@dataclass(slots=True)
class BagIndex:
    """Index of a bag."""

    connections: dict[int, Connection] = field(default_factory=dict)
    chunks: list[Chunk] = field(default_factory=list)


def pack_header(fields: Mapping[str, bytes]) -> bytes:
    """Pack a header with its length before it."""
    parts = []
    for name, value in fields.items():
        each = name.encode() + b"=" + value
        parts.append(U32.pack(len(each)) + each)
    data = b"".join(parts)
    return U32.pack(len(data)) + data


def pack_record(op: int, fields: Mapping[str, bytes], data: bytes) -> bytes:
    """Pack a whole record."""
    return pack_header({"op": bytes([op]), **fields}) + U32.pack(len(data)) + data


def pack_message(connection: int, nanoseconds: int, data: Buffer) -> bytes:
    """Return the bytes that precede a message's data."""
    seconds, rest = divmod(nanoseconds, SECOND)
    return _MESSAGE.pack(
        _MESSAGE_HEADER, 4, b"op=\x02", 9, b"conn=", connection, 13, b"time=", seconds, rest,
        len(data),
    )  # fmt: skip


def pack_time(nanoseconds: int) -> bytes:
    """Pack a time as seconds and nanoseconds."""
    return TIME.pack(*divmod(nanoseconds, SECOND))


def pack_connection(connection: Connection) -> bytes:
    """Pack a connection's record."""
    fields = {key: value.encode() for key, value in connection.header.items()}
    fields.setdefault("topic", connection.topic.encode())
    inner = pack_header(fields)[4:]
    return pack_record(
        CONNECTION, {"conn": U32.pack(connection.id), "topic": connection.topic.encode()}, inner
    )


class Fields(dict[str, bytes]):
    """The fields of a header."""

    @property
    def op(self) -> int:
        """Kind of record; -1 if it is not given."""
        value = self.get("op", b"")
        return value[0] if len(value) == 1 else -1

    def u32(self, name: str) -> int:
        """Return a 32-bit number.

        Raises:
            BagFormatError: There is none.
        """
        return self._number(name, U32)

    def u64(self, name: str) -> int:
        """Return a 64-bit number.

        Raises:
            BagFormatError: There is none.
        """
        return self._number(name, U64)

    def time(self, name: str) -> int:
        """Return a time in nanoseconds.

        Raises:
            BagFormatError: There is none.
        """
        value = self.get(name, b"")
        if len(value) != 8:
            raise BagFormatError(f"a record has no time '{name}'")
        seconds, nanoseconds = TIME.unpack(value)
        return int(seconds) * SECOND + int(nanoseconds)

    def text(self, name: str) -> str:
        """Return a text; empty if there is none."""
        return self.get(name, b"").decode("utf-8", errors="replace")

    def _number(self, name: str, form: struct.Struct) -> int:
        value = self.get(name, b"")
        if len(value) != form.size:
            raise BagFormatError(f"a record has no number '{name}'")
        return int(form.unpack(value)[0])


def unpack_fields(data: Buffer) -> Fields:
    """Return the fields of a header, or of a connection's data.

    Raises:
        BagFormatError: A field is longer than the header, or is none.
    """
    fields, position, end = Fields(), 0, len(data)
    while position < end:
        if position + 4 > end:
            raise BagFormatError("a field's length is cut off")
        (length,) = U32.unpack_from(data, position)
        position += 4
        if length > end - position:
            raise BagFormatError(f"a field of {length} bytes exceeds its header")
        name, equals, value = bytes(data[position : position + length]).partition(b"=")
        if not equals:
            raise BagFormatError("a field of a header has no '='")
        fields[name.decode("utf-8", errors="replace")] = value
        position += length
    return fields


def read_record(data: Buffer, position: int) -> tuple[Fields, int, int]:
    """Read a record in a buffer: its header, and the range of its data.

    Raises:
        BagFormatError: It is malformed, or goes beyond the end of the buffer.
    """
    end = len(data)
    if position < 0 or position + 4 > end:
        raise BagFormatError(f"there is no record at byte {position}")
    (length,) = U32.unpack_from(data, position)
    begin = position + 4
    if length > end - begin - 4:
        raise BagFormatError(f"the record at byte {position} is cut off")
    fields = unpack_fields(data[begin : begin + length])
    (size,) = U32.unpack_from(data, begin + length)
    begin += length + 4
    if size > end - begin:
        raise BagFormatError(f"the data of the record at byte {position} are cut off")
    return fields, begin, begin + size


def message_at(data: Buffer, position: int) -> tuple[int, int]:
    """Return start and end of the data of the message at a position, skipping connections before it.

    Raises:
        BagFormatError: There is no message.
    """
    end = len(data)
    if position + 4 <= end:
        (length,) = U32.unpack_from(data, position)
        if length == _MESSAGE_HEADER and position + 46 <= end:
            # Two orders of fields are usual: rosbag's in Python and in C++.
            place = position + (11 if data[position + 8] == 0x6F else 24)
            (size,) = U32.unpack_from(data, position + 42)
            if data[place] == MESSAGE and position + 46 + size <= end:
                return position + 46, position + 46 + size
    while True:
        fields, begin, stop = read_record(data, position)
        if fields.op == MESSAGE:
            return begin, stop
        if fields.op != CONNECTION:
            raise BagFormatError(f"there is no message at byte {position} of a chunk")
        position = stop


def connection_of(fields: Fields, data: Buffer) -> Connection:
    """Return the connection that a record describes.

    Raises:
        BagFormatError: It is malformed.
    """
    inner = unpack_fields(data)
    header = {name: value.decode("utf-8", errors="replace") for name, value in inner.items()}
    return Connection(fields.u32("conn"), fields.text("topic"), header)
