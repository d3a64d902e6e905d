"""rostopic's interface: topics of the graph."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from typing import Any

from gazelle_ros.compat import commands
from gazelle_ros.compat.rospy.rostime import get_rostime, is_rostime_initialized
from gazelle_ros.compat.rospy.state import process
from gazelle_ros.compat.rospy.topics import Publisher
from gazelle_ros.compat.tool_errors import raising
from gazelle_ros.messages import UnknownTypeError, load_message
from gazelle_ros.messages.yaml import fill_message_args
from gazelle_ros.msgs import std_msgs
from gazelle_ros.time import Time
from gazelle_ros.tools import listing
from gazelle_ros.tools.fields import parse_path, value_at
from gazelle_ros.tools.graph import GraphInspector
from gazelle_ros.tools.rates import RateMeter

Evaluator = Callable[[Any], Any]


class ROSTopicException(Exception):  # noqa: N818  # rostopic's names
    """Root of the errors about topics."""


class ROSTopicIOException(ROSTopicException):
    """The master does not answer."""


def _graph() -> GraphInspector:
    return GraphInspector("rostopic")


@raising(ROSTopicIOException, ROSTopicIOException)
def get_topic_type(
    topic: str,
    blocking: bool = False,  # noqa: FBT001, FBT002  # rostopic's interface
) -> tuple[str | None, str | None, Evaluator | None]:
    """Return the type of a topic, its name, and a function for the requested field.

    Args:
        topic: Name of a topic, perhaps with a path of fields.
        blocking: Wait until there is one.

    Returns:
        All None if there is none.

    Raises:
        ROSTopicIOException: The master does not answer.
    """
    graph = _graph()
    while True:
        found = listing.find_topic(graph, graph.resolve(topic))
        if found is not None:
            name, kind, path = found
            return kind, name, msgevalgen(path) if path else None
        if not blocking or process.shutdown.wait(0.1):
            return None, None, None


def get_topic_class(
    topic: str,
    blocking: bool = False,  # noqa: FBT001, FBT002  # rostopic's interface
) -> tuple[Any, str | None, Evaluator | None]:
    """Return the same as `get_topic_type`, with the class of the messages.

    Raises:
        ROSTopicException: The type is not known.
    """
    kind, name, evaluator = get_topic_type(topic, blocking)
    if kind is None:
        return None, None, None
    try:
        return load_message(kind), name, evaluator
    except UnknownTypeError as error:
        raise ROSTopicException(f"Cannot load message class for [{kind}]: {error}") from None


def msgevalgen(pattern: str) -> Evaluator | None:
    """Return a function that finds a field by its path, such as ``/pose/position[0]``."""
    if not pattern or pattern == "/":
        return None
    steps = parse_path(pattern)
    return lambda message: value_at(message, steps)


def get_topic_list(master: Any = None) -> tuple[list[Any], list[Any]]:
    """Return name, type and nodes of published and of subscribed topics.

    Raises:
        ConnectionRefusedError: There is no master.
    """
    del master
    return _graph().uses()


@raising(ROSTopicIOException)
def find_by_type(topic_type: str) -> list[str]:
    """Return topics of a type."""
    return listing.topics_of_type(_graph(), topic_type)


@raising(ROSTopicIOException, ROSTopicException)
def get_info_text(topic: str) -> str:
    """Return type, publishers and subscribers of a topic.

    Raises:
        ROSTopicException: There is none.
    """
    return listing.topic_info(_graph(), topic)


def create_publisher(
    topic_name: str,
    topic_type: str,
    latch: bool,  # noqa: FBT001  # rostopic's interface
    disable_rostime: bool = True,  # noqa: FBT001, FBT002
) -> tuple[Publisher, Any]:
    """Create a publisher; also returns the class of its messages, and initialises a node.

    Raises:
        ROSTopicException: The type is not known.
    """
    from gazelle_ros.compat.rospy.client import init_node

    try:
        kind = load_message(topic_type)
    except UnknownTypeError as error:
        raise ROSTopicException(f"invalid message type: {topic_type}: {error}") from None
    if process.node is None:
        init_node("rostopic", anonymous=True, disable_rosout=True, disable_rostime=disable_rostime)
    return Publisher(topic_name, kind, latch=latch, queue_size=100), kind


def publish_message(
    pub: Publisher,
    msg_class: Any,
    pub_args: list[Any],
    rate: float | None = None,
    once: bool = False,  # noqa: FBT001, FBT002  # rostopic's interface
    verbose: bool = False,  # noqa: FBT001, FBT002
    substitute_keywords: bool = False,  # noqa: FBT001, FBT002
) -> None:
    """Publish a message of values as users write them: once, or at a rate [Hz] until the end."""
    from gazelle_ros.compat.rospy.timer import Rate, sleep

    del verbose, substitute_keywords
    message = msg_class()
    now = get_rostime() if is_rostime_initialized() else Time()
    keys = {"now": now, "auto": std_msgs.msg.Header(stamp=now)}
    fill_message_args(message, pub_args, keys=keys)
    if rate is None:
        pub.publish(message)
        if once:
            sleep(3.0)
        return
    pace = Rate(rate)
    while not process.shutdown.is_set():
        pub.publish(message)
        pace.sleep()


class ROSTopicHz:
    """Measures how often messages come.

    Args:
        window_size: Number of latest messages; below 0 for nearly all.
        filter_expr: Counts only the messages it accepts.
        use_wtime: Go by the time of the machine.
    """

    def __init__(
        self,
        window_size: int,
        filter_expr: Callable[[Any], bool] | None = None,
        use_wtime: bool = False,  # noqa: FBT001, FBT002  # rostopic's interface
    ) -> None:
        self._window = window_size
        self._keep = filter_expr
        self._wall = use_wtime
        self._meters: dict[str | None, RateMeter] = {}

    def callback_hz(self, m: Any, topic: str | None = None) -> None:
        """Count a message."""
        if self._keep is not None and not self._keep(m):
            return
        wall = self._wall or not is_rostime_initialized()
        now = time.time() if wall else get_rostime().to_sec()
        self._meters.setdefault(topic, RateMeter(self._window)).add(now)

    def get_hz(self, topic: str | None = None) -> tuple[float, float, float, float, int] | None:
        """Return rate [Hz], smallest and largest gap, their spread [s], and number of messages."""
        meter = self._meters.get(topic)
        return None if meter is None else meter.read()

    def print_hz(self, topics: tuple[str | None, ...] = (None,)) -> None:
        """Log the rates."""
        from gazelle_ros.compat.rospy.logs import loginfo

        for topic in topics:
            found = self.get_hz(topic)
            if found is None:
                loginfo("no new messages")
                continue
            rate, least, most, spread, count = found
            loginfo(
                f"average rate: {rate:.3f}\n\tmin: {least:.3f}s max: {most:.3f}s "
                f"std dev: {spread:.5f}s window: {count}"
            )


def rostopicmain(argv: Sequence[str] | None = None) -> None:
    """Run rostopic's command line; see `gazelle_ros.compat.commands.run`.

    Args:
        argv: The command line, by default this process's.

    Raises:
        SystemExit: It failed.
    """
    commands.run("topic", argv)
