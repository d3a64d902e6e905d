"""Publish messages written as YAML."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any, TextIO

from gazelle_ros.base import bounded_yaml
from gazelle_ros.base.text_files import read_text
from gazelle_ros.clock import Rate
from gazelle_ros.messages import Message, MessageException, load_message
from gazelle_ros.messages.yaml import fill_message_args, get_printable_message_args
from gazelle_ros.msgs import std_msgs
from gazelle_ros.node import Node
from gazelle_ros.publishing import Publisher
from gazelle_ros.time import Time
from gazelle_ros.tools.errors import ToolError
from gazelle_ros.tools.fields import keep_text_fields
from gazelle_ros.tools.graph import GraphInspector
from gazelle_ros.tools.watching import tool_node

ONCE_S = 3.0
"""Time that a message is offered with ``--once``, so that subscribers can connect."""
_PATIENCE_S = 1.0
_PIPED_HZ = 10.0


def parse_arguments(words: Iterable[str]) -> list[Any]:
    """Parse words of a command line as YAML values.

    Raises:
        ToolError: One is not YAML.
    """
    import yaml

    found = []
    for word in words:
        try:
            found.append(bounded_yaml.safe_load(word) if word else "")
        except yaml.YAMLError as error:
            raise ToolError(f"'{word}' is not valid YAML: {error}") from None
    return found


def documents(stream: TextIO) -> Iterator[list[Any]]:
    """Yield the YAML documents of a stream, once each is complete: when ``---`` follows it.

    What is after the last ``---`` is not complete and left out.
    """
    lines: list[str] = []
    for line in stream:
        if line.strip() != "---":
            lines.append(line)
            continue
        (value,) = parse_arguments(["".join(lines)]) if "".join(lines).strip() else (None,)
        lines = []
        if value is not None:
            yield value if isinstance(value, list) else [value]


def file_documents(path: str) -> list[list[Any]]:
    """Return the YAML documents of a file.

    Raises:
        ToolError: The file cannot be read, or is not YAML.
    """
    import yaml

    try:
        text = read_text(Path(path))
        return [[each] for each in bounded_yaml.safe_load_all(text) if each is not None]
    except OSError as error:
        raise ToolError(f"{path} cannot be read: {error.strerror}") from None
    except yaml.YAMLError as error:
        raise ToolError(f"{path} is not valid YAML: {error}") from None


class MessagePublisher:
    """Publishes what users write.

    Args:
        graph: The graph.
        topic: Topic to publish.
        kind: The type of the messages.
        out: Gets what is said meanwhile.
        stop: Ends all.
        latch: Keep the last message for late subscribers.
        verbose: Write the messages.
        ros_time: Stamp with simulated time where there is one.
    """

    def __init__(
        self,
        graph: GraphInspector,
        topic: str,
        kind: str,
        out: TextIO,
        stop: threading.Event,
        *,
        latch: bool = False,
        verbose: bool = False,
        ros_time: bool = False,
    ) -> None:
        self._class: Any = load_message(kind)
        self._out = out
        self._stop = stop
        self._verbose = verbose
        self._ros_time = ros_time
        self._node: Node = tool_node(graph)
        try:
            name = graph.resolve(topic)
            self._publisher: Publisher = self._node.advertise(
                name, self._class, queue_size=100, latch=latch
            )
        except BaseException:
            self._node.close()
            raise

    @property
    def takes_values(self) -> bool:
        """True if messages of the type have fields."""
        return bool(self._class.__slots__)

    def close(self) -> None:
        """Unregister."""
        self._node.close()

    def message(self, arguments: list[Any]) -> Any:
        """Return a message from values.

        Raises:
            ToolError: They do not fit its fields.
        """
        made = self._class()
        self._fill(made, arguments)
        return made

    def _fill(self, message: Message, arguments: list[Any]) -> None:
        now = Time(nsecs=self._node.clock.now() if self._ros_time else time.time_ns())
        keys = {"now": now, "auto": std_msgs.msg.Header(stamp=now)}
        try:
            fill_message_args(message, keep_text_fields(message, arguments), keys=keys)
        except (MessageException, ValueError) as error:
            known = get_printable_message_args(message)
            raise ToolError(f"{error}", hint=f"Args are: [{known}]") from None

    def publish(self, message: Message) -> None:
        """Publish a message.

        Raises:
            ToolError: A field has a value of the wrong type.
        """
        try:
            self._publisher.publish(message)
        except MessageException as error:
            raise ToolError(f"the message cannot be sent: {error}") from None

    def latched(self, arguments: list[Any], *, once: bool) -> None:
        """Publish one message and offer it for a while, or until the end."""
        message = self.message(arguments)
        what = f"[{message}]" if self._verbose else "message"
        rest = f" for {ONCE_S} seconds" if once else ". Press ctrl-C to terminate"
        self._write_line(f"publishing and latching {what}{rest}")
        self.publish(message)
        self._stop.wait(ONCE_S if once else None)

    def repeated(self, arguments: list[Any], hertz: float, *, fresh: bool) -> None:
        """Publish a message again and again.

        Args:
            arguments: Its values.
            hertz: Rate [Hz].
            fresh: Let ``now`` and ``auto`` mean the time of each.
        """
        message = self.message(arguments)
        rate = Rate(self._node.clock, hertz, reset=True)
        while not self._stop.is_set():
            if fresh:
                self._fill(message, arguments)
            if self._verbose:
                self._write_line(f"publishing {message}")
            self.publish(message)
            if not rate.sleep(self._stop.is_set):
                break

    def several(self, values: Iterable[list[Any]], hertz: float | None, *, once: bool) -> None:
        """Publish messages one after another, at a rate if there is one."""
        self._wait_for_subscriber()
        rate = None if hertz is None else Rate(self._node.clock, hertz, reset=True)
        for arguments in values:
            if self._stop.is_set():
                return
            if rate is None:
                self.latched(arguments, once=once)
                if once:
                    return
                continue
            message = self.message(arguments)
            if self._verbose:
                self._write_line(f"publishing {message}")
            self.publish(message)
            if once:
                self._stop.wait(ONCE_S)
                return
            rate.sleep(self._stop.is_set)

    def _wait_for_subscriber(self) -> None:
        """Wait a moment for subscribers, as messages may be over in no time."""
        deadline = time.monotonic() + _PATIENCE_S
        while self._publisher.num_connections == 0 and time.monotonic() < deadline:
            if self._stop.wait(0.01):
                return

    def _write_line(self, text: str) -> None:
        self._out.write(f"{text}\n")
        self._out.flush()


def publish(
    publisher: MessagePublisher,
    arguments: list[Any],
    source: Iterable[list[Any]] | None,
    *,
    hertz: float | None = None,
    once: bool = False,
    latch: bool = False,
    fresh: bool = False,
) -> None:
    """Publish as ``rostopic pub`` does.

    Args:
        publisher: Does it.
        arguments: The values of one message.
        source: Values of several messages instead; None to publish the one.
        hertz: Rate [Hz].
        once: One message only.
        latch: Keep the last for late subscribers.
        fresh: Let ``now`` and ``auto`` mean the time of each message.
    """
    if source is None:
        if hertz is None:
            publisher.latched(arguments, once=once)
        else:
            publisher.repeated(arguments, hertz, fresh=fresh)
        return
    if isinstance(source, list) and len(source) == 1 and hertz is not None and not once:
        publisher.repeated(source[0], hertz, fresh=fresh)
        return
    if hertz is None and not once and not latch:
        hertz = _PIPED_HZ
    publisher.several(source, hertz, once=once)
