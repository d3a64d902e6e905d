"""Write messages as they come."""

from __future__ import annotations

import sys
import threading
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any, TextIO

from gazelle_ros.errors import RosError
from gazelle_ros.expressions import compiled
from gazelle_ros.messages import Message, load_message
from gazelle_ros.raw import RawMessage
from gazelle_ros.time import Time
from gazelle_ros.tools.errors import ToolError
from gazelle_ros.tools.fields import FieldAccess, parse_path, type_at, value_at
from gazelle_ros.tools.formatting import Plot, as_yaml, leave_out
from gazelle_ros.tools.graph import GraphInspector
from gazelle_ros.tools.watching import tool_node, wait_for_topic
from gazelle_ros.typed import decode

_CLEAR = "\033[2J\033[;H"
_SILENCE_S = 2.0


@dataclass(frozen=True, slots=True, kw_only=True)
class EchoOptions:
    """Options for printing messages."""

    count: int | None = None
    """Stop after so many."""
    plot: bool = False
    """As comma-separated values."""
    no_strings: bool = False
    no_arrays: bool = False
    clear: bool = False
    """Clear the screen before each."""
    offset: bool = False
    """Times as what passed since then."""
    width: int | None = None
    """Characters of each number."""
    keep: Callable[[Any], bool] | None = None
    """Predicate of the messages that are written; it gets whole messages."""


class Echo:
    """Writes messages, or parts of them.

    Args:
        out: Gets the text.
        options: Options of the output.
        steps: The part of each message.
        kind: The type of that part, if it is not a message.
    """

    def __init__(
        self,
        out: TextIO,
        options: EchoOptions,
        steps: Iterable[FieldAccess] = (),
        kind: str | None = None,
    ) -> None:
        self._out = out
        self._options = options
        self._steps = list(steps)
        self._kind = kind
        self._plot = Plot(strings=options.no_strings, arrays=options.no_arrays)
        both = {"strings": options.no_strings, "arrays": options.no_arrays}
        self._transform = leave_out(**both) if any(both.values()) else None
        self.count = 0

    @property
    def done(self) -> bool:
        """True if the requested number of messages was written."""
        return self._options.count is not None and self.count >= self._options.count

    def write(self, message: Any, now: Time, steps: Iterable[FieldAccess] | None = None) -> None:
        """Write a message, or another part of it than usual.

        Raises:
            ToolError: It has not the requested field.
        """
        options = self._options
        if self.done or (options.keep is not None and not options.keep(message)):
            return
        value = value_at(message, self._steps if steps is None else list(steps))
        offset = now if options.offset else None
        if options.plot:
            if self.count == 0:
                self._out.write(self._plot.header(value) + "\n")
            self._out.write(self._plot.line(value, now, offset=offset) + "\n")
        else:
            prefix = _CLEAR if options.clear else ""
            self._out.write(prefix + self._text(value, offset) + "\n---\n")
        self._out.flush()
        self.count += 1

    def _text(self, value: Any, offset: Time | None) -> str:
        if isinstance(value, bytes) and (self._kind or "").startswith("uint8["):
            value = list(value)
        if self._transform is not None:
            value = self._transform(value, self._kind)
        return as_yaml(value, offset=offset, width=self._options.width)


def echo(
    graph: GraphInspector, name: str, out: TextIO, options: EchoOptions, stop: threading.Event
) -> None:
    """Write the messages of a topic, or a field of them, until `stop` is set.

    Raises:
        ToolError: The messages have not the requested field.
    """
    found = wait_for_topic(graph, name, stop)
    if found is None:
        return
    topic, kind, path = found
    steps = parse_path(path)
    writer = Echo(out, options, steps, _leaf_type(kind, steps))
    failed: list[RosError | OSError] = []
    with tool_node(graph) as node:

        def show(raw: Any) -> None:
            if failed or writer.done:
                return
            try:
                nanoseconds = node.clock.now()
                writer.write(decode(raw), Time(nsecs=nanoseconds))
            except (RosError, OSError) as error:  # the output is full, or closed
                failed.append(error)
            if failed or writer.done:
                stop.set()

        node.subscribe(topic, RawMessage, show)
        _wait(writer, stop, simulated=node.clock.simulated)
    if failed:
        raise failed[0]


def _wait(writer: Echo, stop: threading.Event, *, simulated: bool) -> None:
    if simulated and not stop.wait(_SILENCE_S) and writer.count == 0:
        sys.stderr.write(
            "WARNING: no messages received and simulated time is active.\n"
            "Is /clock being published?\n"
        )
    stop.wait()


def _leaf_type(kind: str, steps: list[FieldAccess]) -> str | None:
    """Return the type of a field, if the message's type is known and it is not a message."""
    if not steps:
        return None
    from gazelle_ros.base.errors import Error

    try:
        return type_at(load_message(kind), steps)
    except ToolError:
        raise
    except Error:
        return None


def echo_bag(
    path: str, topic: str | None, out: TextIO, options: EchoOptions, stop: threading.Event
) -> None:
    """Write the messages of a bag, of one topic or all.

    Raises:
        RosError: The file is not a bag.
    """
    from gazelle_ros.bags import Bag

    with Bag(path) as bag:
        writer = Echo(out, options)
        for each in bag.read_messages():
            if stop.is_set() or writer.done:
                break
            where = _within(each.topic, topic)
            if where is not None:
                writer.write(each.message, each.timestamp, where)


def _within(topic: str, path: str | None) -> list[FieldAccess] | None:
    """Return the steps from a topic to a wanted field; None if it is another topic."""
    if path is None or topic == path:
        return []
    return parse_path(path[len(topic) :]) if path.startswith(topic + "/") else None


def filter_of(expression: str) -> Callable[[Message], bool]:
    """Compile a function of a message ``m`` from a Python expression.

    Raises:
        ToolError: It is not an expression; and by the function where it fails.
    """
    value = compiled(expression, ToolError)
    return lambda message: bool(value(m=message))
