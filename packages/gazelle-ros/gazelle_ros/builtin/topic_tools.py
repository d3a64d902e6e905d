"""Nodes of topic_tools: relay, throttle, drop and mux (http://wiki.ros.org/topic_tools)."""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable, Sequence
from typing import Any

from gazelle_ros.base.errors import RosError
from gazelle_ros.base.parameter_values import positive
from gazelle_ros.builtin.arguments import parse_arguments, spin
from gazelle_ros.msgs import std_msgs, topic_tools
from gazelle_ros.node import Node
from gazelle_ros.publishing import Publisher
from gazelle_ros.raw import RawMessage

Pass = Callable[[RawMessage], bool]
"""Predicate of messages that are passed on."""


class Repeater:
    """Publishes messages of any type on a topic, as what the first of them is.

    Args:
        node: Publishes.
        topic: Topic to subscribe to.
    """

    def __init__(self, node: Node, topic: str) -> None:
        self._node = node
        self._topic = topic
        self._publisher: Publisher | None = None
        self._lock = threading.Lock()

    def publish(self, message: RawMessage) -> None:
        """Publish a message."""
        with self._lock:
            if self._publisher is None:
                self._publisher = self._advertise(message._connection_header)  # rospy's name
        self._publisher.publish(self._publisher.message_class(message._buff))

    def _advertise(self, header: dict[str, str]) -> Publisher:
        made = type(
            "Repeated",
            (RawMessage,),
            {
                "__slots__": (),
                "_type": header.get("type", "*"),
                "_md5sum": header.get("md5sum", "*"),
                "_full_text": header.get("message_definition", ""),
            },
        )
        latch = header.get("latching") == "1"
        return self._node.advertise(self._topic, made, queue_size=10, latch=latch)


def relay(arguments: Sequence[str]) -> int:
    """Publish the messages of a topic on another; returns the exit code."""
    found = parse_arguments(arguments, "relay", anonymous=True)
    source, target = _topics(found.plain, "relay IN_TOPIC [OUT_TOPIC]", "_relay")
    with found.start() as node:
        return _pass_on(node, source, target, lambda _message: True)


def throttle(arguments: Sequence[str]) -> int:
    """Forward a given number of messages, or bytes, per second at most; returns the exit code."""
    usage = (
        "throttle messages IN_TOPIC MESSAGES_PER_SECOND [OUT_TOPIC], "
        "or throttle bytes IN_TOPIC BYTES_PER_SECOND WINDOW [OUT_TOPIC]"
    )
    found = parse_arguments(arguments, "throttle", anonymous=True)
    kind, *words = found.plain or [""]
    numbers = {"messages": 1, "bytes": 2}.get(kind, 0)
    if not numbers or len(words) < 1 + numbers:
        raise RosError("the arguments are wrong", hint=usage)
    limits = [positive("the number", each, usage) for each in words[1 : 1 + numbers]]
    source, target = _topics([words[0], *words[1 + numbers :]], usage, "_throttle")
    gate: Pass = _MessageGate(limits[0]).passes if kind == "messages" else _ByteGate(*limits).passes
    with found.start() as node:
        return _pass_on(node, source, target, gate)


def drop(arguments: Sequence[str]) -> int:
    """Drop X of every Y messages; returns the exit code."""
    usage = "drop IN_TOPIC X Y [OUT_TOPIC]"
    found = parse_arguments(arguments, "drop", anonymous=True)
    if len(found.plain) < 3:
        raise RosError("there are too few arguments", hint=usage)
    topic, dropped, every = found.plain[:3]
    try:
        left_out, of = int(dropped), int(every)
    except ValueError:
        raise RosError("X and Y are ints", hint=usage) from None
    if not 0 <= left_out <= of or of < 1:
        raise RosError("X is at least 0 and at most Y", hint=usage)
    source, target = _topics([topic, *found.plain[3:]], usage, "_drop")
    count = -1

    def passes(_message: RawMessage) -> bool:
        nonlocal count
        count = (count + 1) % of
        return count >= left_out

    with found.start() as node:
        return _pass_on(node, source, target, passes)


def _pass_on(node: Node, source: str, target: str, passes: Pass) -> int:
    if node.resolve(source) == node.resolve(target):
        raise RosError(f"{source} would be published on itself")
    repeater = Repeater(node, target)

    def take(message: RawMessage) -> None:
        if passes(message):
            repeater.publish(message)

    node.subscribe(source, RawMessage, take, queue_size=10)
    return spin(node)


def _topics(words: Sequence[str], usage: str, suffix: str) -> tuple[str, str]:
    if not 1 <= len(words) <= 2:
        raise RosError("give one topic or two", hint=usage)
    return words[0], words[1] if len(words) == 2 else words[0] + suffix


class _MessageGate:
    """Lets through a given number of messages per second at most."""

    def __init__(self, per_second: float) -> None:
        self._gap = 1.0 / per_second
        self._last = float("-inf")

    def passes(self, _message: RawMessage) -> bool:
        now = time.monotonic()
        if now - self._last < self._gap:
            return False
        self._last = now
        return True


class _ByteGate:
    """Lets through a given number of bytes per second at most, over a window of time [s]."""

    def __init__(self, per_second: float, window: float) -> None:
        self._limit = per_second * window
        self._window = window
        self._sent: deque[tuple[float, int]] = deque()

    def passes(self, message: RawMessage) -> bool:
        now = time.monotonic()
        while self._sent and self._sent[0][0] < now - self._window:
            self._sent.popleft()
        if sum(size for _, size in self._sent) >= self._limit:
            return False
        self._sent.append((now, len(message._buff)))  # rospy's name
        return True


def mux(arguments: Sequence[str]) -> int:
    """Forward one of several topics, chosen by a service; returns the exit code."""
    found = parse_arguments(arguments, "mux")
    if len(found.plain) < 2:
        raise RosError(
            "there are too few arguments", hint="mux OUT_TOPIC IN_TOPIC1 [IN_TOPIC2 ...]"
        )
    with found.start() as node:
        Mux(node, found.plain[0], found.plain[1:])
        return spin(node)


class Mux:
    """Passes on one of several topics.

    Services ``~select``, ``~add``, ``~delete`` and ``~list`` choose, topic ``~selected`` reports.

    Args:
        node: Does it.
        target: The topic to publish.
        sources: The topics to choose from; the first is chosen.
    """

    NONE = "__none"

    def __init__(self, node: Node, target: str, sources: Sequence[str]) -> None:
        from gazelle_ros.messages import load_service

        self._node = node
        self._repeater = Repeater(node, target)
        self._sources: dict[str, Any] = {}
        self._selected = self.NONE
        self._text = std_msgs.msg.String
        self._selected_publisher = node.advertise("~selected", self._text, latch=True)
        for source in sources:
            self._add(node.resolve(source))
        self._choose(node.resolve(sources[0]))
        for name, handler in (
            ("Select", self._on_select),
            ("Add", self._on_add),
            ("Delete", self._on_delete),
            ("List", self._on_list),
        ):
            node.serve(f"~{name.lower()}", load_service(f"topic_tools/Mux{name}"), handler)

    def _add(self, topic: str) -> None:
        def take(message: RawMessage) -> None:
            if self._selected == topic:
                self._repeater.publish(message)

        self._sources[topic] = self._node.subscribe(topic, RawMessage, take, queue_size=10)

    def _choose(self, topic: str) -> str:
        previous, self._selected = self._selected, topic
        self._selected_publisher.publish(self._text(data=topic))
        return previous

    def _on_select(self, request: topic_tools.srv.MuxSelectRequest) -> Any:
        topic = request.topic if request.topic == self.NONE else self._node.resolve(request.topic)
        if topic != self.NONE and topic not in self._sources:
            raise RosError(f"there is no topic {topic} to choose")
        return [self._choose(topic)]

    def _on_add(self, request: topic_tools.srv.MuxAddRequest) -> Any:
        topic = self._node.resolve(request.topic)
        if request.topic == self.NONE or topic in self._sources:
            raise RosError(f"the topic {topic} cannot be added")
        self._add(topic)
        return []

    def _on_delete(self, request: topic_tools.srv.MuxDeleteRequest) -> Any:
        topic = self._node.resolve(request.topic)
        if topic not in self._sources or topic == self._selected:
            raise RosError(f"the topic {topic} cannot be deleted")
        self._sources.pop(topic).close()
        return []

    def _on_list(self, _request: topic_tools.srv.MuxListRequest) -> Any:
        return [list(self._sources)]
