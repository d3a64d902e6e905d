"""Bags as MCAP files, which Foxglove and others read (https://mcap.dev, profile ``ros1``)."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from gazelle_ros.bags.errors import BagError
from gazelle_ros.bags.reader import BagReader
from gazelle_ros.bags.records import Connection
from gazelle_ros.base.errors import MissingExtraError
from gazelle_ros.base.writing import replacing

_METADATA = ("callerid", "latching", "md5sum")


def write_mcap(source: str, target: str) -> int:
    """Copy a bag into an MCAP file; messages stay as they are on the wire.

    Args:
        source: A bag.
        target: The file to write, all or nothing.

    Returns:
        How many messages it has.

    Raises:
        BagError: The source is not a bag, or the target is there already or cannot be written.
        MissingExtraError: The package ``mcap`` is not installed.
    """
    try:
        from mcap.writer import Writer
    except ImportError:
        raise MissingExtraError("mcap", "bags", "gazelle-ros") from None
    path = Path(target)
    if path.exists():
        raise BagError("there is such a file already", file=target, hint="give another name")
    reader = BagReader(source)
    try:
        with replacing(path) as draft, draft.open("wb") as file:
            count = _copy(reader, Writer(file))
    except OSError as error:
        raise BagError(f"cannot write it: {error.strerror}", file=target) from error
    finally:
        reader.close()
    return count


def _copy(reader: BagReader, writer: Any) -> int:
    writer.start(profile="ros1", library="gazelle")
    schemas: dict[tuple[str, str], int] = {}
    channels: dict[int, int] = {}
    count = 0
    for entry in reader.messages():
        connection = entry.connection
        if connection.id not in channels:
            channels[connection.id] = _channel(writer, connection, schemas)
        channel = channels[connection.id]
        writer.add_message(channel, entry.time, bytes(entry.data), entry.time, sequence=count)
        count += 1
    writer.finish()
    return count


def _channel(writer: Any, connection: Connection, schemas: dict[tuple[str, str], int]) -> int:
    """Return a channel for a connection, with a schema for its type if that is new."""
    definition = connection.header.get("message_definition", "")
    key = (connection.type, definition)
    if key not in schemas:
        schemas[key] = writer.register_schema(connection.type, "ros1msg", definition.encode())
    metadata = {name: connection.header[name] for name in _METADATA if name in connection.header}
    number: int = writer.register_channel(connection.topic, "ros1", schemas[key], metadata)
    return number
