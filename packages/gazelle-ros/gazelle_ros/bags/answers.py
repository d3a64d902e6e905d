"""Named tuples that a bag returns, with the names of ``rosbag``'s."""

from __future__ import annotations

import itertools
import statistics
from collections.abc import Collection
from typing import Any, NamedTuple

from gazelle_ros.bags.reader import BagFile, select
from gazelle_ros.bags.records import BagIndex, Connection
from gazelle_ros.clock import SECOND
from gazelle_ros.time import Time


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
    """Summary of a topic in a bag."""

    msg_type: str
    message_count: int
    connections: int
    frequency: float | None
    """Median rate [Hz]."""


class TypesAndTopicsTuple(NamedTuple):
    """Types and topics of a bag."""

    msg_types: dict[str, str]
    """Checksums by type."""
    topics: dict[str, TopicTuple]


class CompressionTuple(NamedTuple):
    """Compression of a bag."""

    compression: str
    uncompressed: int
    compressed: int


def types_and_topics(
    file: BagFile, index: BagIndex, connections: Collection[int] | None
) -> TypesAndTopicsTuple:
    """Return types with their checksums, and the numbers of each topic.

    Args:
        file: The bag's bytes.
        index: Its index.
        connections: Of these connections only; None for all. Types are those of all.
    """
    types: dict[str, str] = {}
    by_topic: dict[str, list[Connection]] = {}
    for connection in index.connections.values():
        types.setdefault(connection.type, connection.md5sum)
        if connections is None or connection.id in connections:
            by_topic.setdefault(connection.topic, []).append(connection)
    found = {}
    for topic, members in sorted(by_topic.items()):
        ids = frozenset(member.id for member in members)
        count = sum(n for chunk in index.chunks for each, n in chunk.counts.items() if each in ids)
        found[topic] = TopicTuple(members[0].type, count, len(members), _rate(file, index, ids))
    return TypesAndTopicsTuple(dict(sorted(types.items())), found)


def _rate(file: BagFile, index: BagIndex, connections: frozenset[int]) -> float | None:
    """Return the rate of messages [Hz], by the median of the times between them."""
    times = select(file, index, connections, None, None)[0]
    gaps = [(after - before) / SECOND for before, after in itertools.pairwise(times.tolist())]
    middle = statistics.median(gaps) if gaps else 0.0
    return float(1.0 / middle) if middle > 0.0 else None


def compression_of(file: BagFile, index: BagIndex, default: str) -> CompressionTuple:
    """Return the most frequent compression, and bytes without and with it."""
    counts = dict[str, int]()
    plain = packed = 0
    for chunk in index.chunks:
        file.describe(chunk)
        counts[chunk.compression] = counts.get(chunk.compression, 0) + 1
        plain, packed = plain + chunk.size, packed + chunk.compressed
    kind = max(counts, key=lambda kind: (counts[kind], kind)) if counts else default
    return CompressionTuple(kind, plain, packed)
