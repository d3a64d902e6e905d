"""Record topics into bags."""

from __future__ import annotations

import contextlib
import re
import threading
import time
from collections import Counter, deque
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import IO

from gazelle_ros import names
from gazelle_ros.bags import records
from gazelle_ros.bags.errors import BagError
from gazelle_ros.bags.records import Connection
from gazelle_ros.bags.writer import CHUNK_BYTES, BagWriter
from gazelle_ros.base.program import program_name
from gazelle_ros.errors import RosError, UnreachableError
from gazelle_ros.master.proxy import value_of
from gazelle_ros.msgs import std_msgs
from gazelle_ros.node import Node
from gazelle_ros.raw import RawMessage
from gazelle_ros.subscribing import Subscriber
from gazelle_ros.xmlrpc.client import BlockingClient

_LOOK_S = 0.5
"""Interval at which it looks for new topics."""
_ACTIVE = ".active"
_KEPT = ("callerid", "latching", "md5sum", "message_definition", "topic", "type")
_DURATION = re.compile(r"(\d+(?:\.\d+)?)([smh]?)")
_UNITS = {"": 1.0, "s": 1.0, "m": 60.0, "h": 3600.0}

Say = Callable[[str], None]


@dataclass(frozen=True, slots=True, kw_only=True)
class RecordOptions:
    """Options for recording bags."""

    topics: Sequence[str] = ()
    """Names, or regular expressions."""
    all_topics: bool = False
    regex: bool = False
    exclude: str = ""
    """A regular expression of topics to leave out."""
    node: str = ""
    """Record all topics that this node subscribes to."""
    prefix: str = ""
    """Goes before date and time in the file's name."""
    name: str = ""
    """The file's name, in place of prefix, date and time."""
    split: bool = False
    """Begin another file at the limits below, instead of ending."""
    most_files: int = 0
    """Of split files, delete the oldest above so many; 0 for none."""
    size: int = 0
    """Bytes of a file at most; 0 for no limit."""
    duration: float = 0.0
    """Seconds of a file at most; 0 for no limit."""
    limit: int = 0
    """Messages of each topic at most; 0 for no limit."""
    compression: str = "none"
    chunk_bytes: int = CHUNK_BYTES
    tcp_nodelay: bool = False
    repeat_latched: bool = False
    """Begin each split file with the latched messages."""
    publish: bool = False
    """Publish the name of each file on ``/begin_write`` when it begins, latched."""


def duration_of(text: str) -> float:
    """Return seconds of a duration like ``30``, ``5m`` or ``2h``.

    Raises:
        BagError: It is none.
    """
    match = _DURATION.fullmatch(text.strip())
    if match is None:
        raise BagError(f"'{text}' is not a duration", hint="write 30, 5m or 2h")
    return float(match.group(1)) * _UNITS[match.group(2)]


@dataclass(slots=True)
class _Output:
    """The file that is written now."""

    path: Path
    stream: IO[bytes]
    writer: BagWriter
    began: float
    connections: dict[tuple[str, str, str], Connection] = field(default_factory=dict)


class BagRecorder:
    """Subscribes to topics and writes their messages.

    Args:
        node: Subscribes.
        options: Options of recording.
        say: Gets lines for people.

    Attributes:
        files: The bags that are complete.
        done: Set when a limit is reached.
    """

    def __init__(self, node: Node, options: RecordOptions, say: Say) -> None:
        self._node = node
        self._options = options
        self._say = say
        self._exclude = _pattern(options.exclude) if options.exclude else None
        self._patterns = [_pattern(each) for each in options.topics] if options.regex else []
        self._subscribers: dict[str, Subscriber] = {}
        self._counts: Counter[str] = Counter()
        self._lock = threading.Lock()
        self._output: _Output | None = None
        self._number = 0
        self._stamp = time.strftime("%Y-%m-%d-%H-%M-%S")
        self._latched: dict[tuple[str, str, str], tuple[dict[str, str], bytes]] = {}
        self._begins = (
            node.advertise("begin_write", std_msgs.msg.String, 1, latch=True)
            if options.publish
            else None
        )
        self.files: deque[Path] = deque()
        self.done = threading.Event()
        self._failed: OSError | None = None
        self._path_now = Path()
        self._kept = ""

    def run(self, stop: threading.Event) -> None:
        """Record until `stop` is set, a limit is reached, or there is no room on the disk.

        Raises:
            BagError: A bag cannot be written; what was written until then is kept.
        """
        try:
            fixed = not (self._options.all_topics or self._options.regex or self._options.node)
            topics = [self._resolved(each) for each in self._options.topics if fixed]
            if self._options.node:
                self._resolved(self._options.node)
            self._open()
            for topic in topics:
                self._subscribe(topic)
            while not stop.is_set() and not self.done.is_set():
                if not fixed:
                    self._subscribe_to_new()
                self._check_time()
                stop.wait(_LOOK_S if not self.done.is_set() else 0)
        finally:
            for subscriber in list(self._subscribers.values()):
                subscriber.close()
            with self._lock:
                self._close()
            if self._begins is not None:
                self._begins.close()
            if self._failed is not None:
                raise BagError(
                    f"it cannot be written: {self._failed.strerror}",
                    file=str(self._path_now),
                    hint=self._kept,
                ) from None

    # Topics ------------------------------------------------------------------------------

    def _resolved(self, name: str) -> str:
        """Return a name in full; a wrong one is an error before there is a file."""
        return names.check(self._node.resolve(names.check(name)))

    def _subscribe_to_new(self) -> None:
        """Subscribe to topics that are new."""
        try:
            topics = list(self._wanted())
        except RosError:
            return  # the master is away; it will be back or not
        for topic in topics:
            if topic not in self._subscribers:
                self._subscribe(topic)

    def _wanted(self) -> Iterable[str]:
        if self._options.node:
            candidates: Iterable[str] = self._topics_of(self._node.resolve(self._options.node))
        else:
            candidates = [topic for topic, _ in self._node.master.published_topics()]
        for topic in candidates:
            if self._exclude is not None and self._exclude.fullmatch(topic):
                continue
            if self._patterns and not any(each.fullmatch(topic) for each in self._patterns):
                continue
            yield topic

    def _topics_of(self, node: str) -> list[str]:
        client = BlockingClient(self._node.master.lookup_node(node), timeout=3.0)
        try:
            answer = client.call("getSubscriptions", self._node.name)
            return [str(topic) for topic, _ in value_of("getSubscriptions", answer)]
        except UnreachableError:
            return []
        finally:
            client.close()

    def _subscribe(self, topic: str) -> None:
        self._say(f"Subscribing to {topic}")
        self._subscribers[topic] = self._node.subscribe(
            topic,
            RawMessage,
            lambda message: self._take(topic, message),
            tcp_nodelay=self._options.tcp_nodelay,
        )

    # Messages, on workers ----------------------------------------------------------------

    def _take(self, topic: str, message: RawMessage) -> None:
        now = self._node.clock.now()
        if not now:
            return  # simulated time did not begin
        header = message._connection_header
        data = message._buff
        with self._lock:
            if self._output is None or self._failed is not None or self._finished(topic):
                return
            self._counts[topic] += 1
            if header.get("latching") == "1" and self._options.repeat_latched:
                self._latched[_key(topic, header)] = (header, data)
            try:
                self._write(topic, header, now, data)
                self._check_size()
            except OSError as error:
                self._fail(error)
            self._finished(topic)

    def _fail(self, error: OSError) -> None:
        """Stop on an error; a full disk would fail for each message that comes."""
        self._failed = self._failed or error
        self.done.set()

    def _write(self, topic: str, header: dict[str, str], now: int, data: bytes) -> None:
        output = self._output
        if output is None:
            return
        key = _key(topic, header)
        connection = output.connections.get(key)
        if connection is None:
            kept = {name: header[name] for name in _KEPT if name in header}
            connection = output.writer.connect(topic, kept | {"topic": topic})
            output.connections[key] = connection
        output.writer.write(connection, now, data)

    def _finished(self, topic: str) -> bool:
        """Return whether the wanted number of messages of a topic is recorded."""
        limit = self._options.limit
        if not limit or self._counts[topic] < limit:
            return False
        if all(self._counts[each] >= limit for each in self._subscribers):
            self.done.set()
        return True

    # Files -------------------------------------------------------------------------------

    def _check_time(self) -> None:
        with self._lock:
            output, limit = self._output, self._options.duration
            if output is not None and limit and time.monotonic() - output.began >= limit:
                try:
                    self._next()
                except OSError as error:
                    self._fail(error)

    def _check_size(self) -> None:
        limit = self._options.size
        if limit and self._output is not None and self._output.writer.size >= limit:
            self._next()

    def _next(self) -> None:
        """Start another file at a limit, or stop."""
        if not self._options.split:
            self.done.set()
            self._close()
            return
        self._close()
        self._open()
        for (topic, _, _), (header, data) in list(self._latched.items()):
            self._write(topic, header, self._node.clock.now(), data)

    def _open(self) -> None:
        path = self._path()
        active = path.with_name(path.name + _ACTIVE)
        try:
            stream = active.open("w+b")
        except OSError as error:
            raise BagError(f"cannot be written: {error.strerror}", file=str(active)) from None
        try:
            writer = BagWriter(
                stream, compression=self._options.compression, chunk_bytes=self._options.chunk_bytes
            )
            stream.flush()
        except OSError as error:
            with contextlib.suppress(OSError):
                stream.close()
            active.unlink()
            raise BagError(f"cannot be written: {error.strerror}", file=str(active)) from None
        self._output = _Output(path, stream, writer, time.monotonic())
        self._say(f"Recording to '{path}'.")
        if self._begins is not None:
            self._begins.publish(self._begins.message_class(data=str(path)))

    def _path(self) -> Path:
        options = self._options
        if options.name:
            base = options.name.removesuffix(".bag")
        else:
            base = f"{options.prefix}_{self._stamp}" if options.prefix else self._stamp
        if options.split:
            base += f"_{self._number}"
            self._number += 1
        return Path(base + ".bag")

    def _close(self) -> None:
        output, self._output = self._output, None
        if output is None:
            return
        active = output.path.with_name(output.path.name + _ACTIVE)
        try:
            if self._failed is not None:
                raise self._failed
            output.writer.close()
            output.stream.close()
        except OSError as error:
            self._fail(error)
            if not self._rescue(output, active):
                return
        active.replace(output.path)
        self.files.append(output.path)
        while self._options.most_files and len(self.files) > self._options.most_files:
            self.files.popleft().unlink(missing_ok=True)

    def _rescue(self, output: _Output, active: Path) -> bool:
        """Write the index of a bag after an error; returns whether there was room for it."""
        self._path_now = output.path
        with contextlib.suppress(OSError):
            output.stream.close()
        try:
            with active.open("r+b") as stream:
                output.writer.close_damaged(stream)
        except OSError:
            self._kept = f"'{program_name()} bag reindex {active}' makes a bag of what was written"
            return False
        self._kept = "what was written until then is kept"
        return True


def _key(topic: str, header: dict[str, str]) -> tuple[str, str, str]:
    return topic, header.get("callerid", ""), header.get("md5sum", "")


def _pattern(text: str) -> re.Pattern[str]:
    try:
        return re.compile(text)
    except re.error as error:
        raise BagError(f"'{text}' is not a regular expression: {error}") from None


def check(options: RecordOptions) -> None:
    """Check that something is to be recorded.

    Raises:
        BagError: Nothing is, or the limits make no sense.
    """
    if not (options.topics or options.all_topics or options.node or options.exclude):
        raise BagError("there is nothing to record", hint="give topics, --all or --node")
    if options.split and not (options.size or options.duration):
        raise BagError("--split needs --size or --duration")
    if options.size and options.size < records.HEADER_BYTES:
        raise BagError("the size is too small for any bag")
