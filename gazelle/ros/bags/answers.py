"""What a bag answers: named tuples, with the names of ``rosbag``'s."""

from __future__ import annotations

from typing import Any, NamedTuple

from gazelle.ros.time import Time


class BagMessage(NamedTuple):
    """A message of a bag."""

    topic: str
    message: Any
    """The message; read raw, a tuple of type, bytes, checksum, place and class."""
    timestamp: Time
    """When it was received."""


class BagMessageWithConnectionHeader(NamedTuple):
    """A message of a bag, and where it came from."""

    topic: str
    message: Any
    timestamp: Time
    connection_header: dict[str, str]


class TopicTuple(NamedTuple):
    """What a bag holds of a topic."""

    msg_type: str
    message_count: int
    connections: int
    frequency: float | None
    """Median rate [Hz]."""


class TypesAndTopicsTuple(NamedTuple):
    """What a bag holds."""

    msg_types: dict[str, str]
    """Checksums by type."""
    topics: dict[str, TopicTuple]


class CompressionTuple(NamedTuple):
    """How a bag is compressed."""

    compression: str
    uncompressed: int
    compressed: int
