"""The node through which MoveIt's clients talk, and messages as bytes."""

from __future__ import annotations

import atexit
import contextlib
import io
import logging
import threading
from collections.abc import Iterable
from typing import TypeVar

from gazelle_ros.builtin.arguments import parse_arguments
from gazelle_ros.compat.rospy.state import process
from gazelle_ros.messages import Message
from gazelle_ros.node import Node

MessageT = TypeVar("MessageT", bound=Message)

LOG = logging.getLogger("rosout")
"""As rospy logs: on the screen, and on /rosout where the node is rospy's."""

_NAME = "move_group_commander_wrappers"


class ClientSession:
    """One node for all clients of a process: rospy's, or one of their own where there is none."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._node: Node | None = None
        self._name, self._arguments = _NAME, []  # type: tuple[str, list[str]]

    def prepare(self, name: str, arguments: Iterable[str]) -> None:
        """Set the name of an own node, and its command line with remappings."""
        self._name, self._arguments = name or _NAME, [str(each) for each in arguments]

    def use(self, node: Node) -> None:
        """Use a node that another owner opens and closes."""
        with self._lock:
            self._node = node

    def node(self) -> Node:
        """Return the node; created on first use."""
        shared = process.node
        if shared is not None and not shared.closed:
            return shared
        with self._lock:
            if self._node is None or self._node.closed:
                found = parse_arguments(self._arguments, self._name, anonymous=True)
                self._node = found.start()
                atexit.register(self.close)
            return self._node

    def close(self) -> None:
        """Close an own node; rospy's is left alone."""
        with self._lock:
            node, self._node = self._node, None
        if node is not None:
            atexit.unregister(self.close)
            with contextlib.suppress(Exception):
                node.close()


session = ClientSession()
"""Of this process."""


def packed(message: Message) -> bytes:
    """Serialise a message."""
    buffer = io.BytesIO()
    message.serialize(buffer)
    return buffer.getvalue()


def unpacked(kind: type[MessageT], data: bytes) -> MessageT:
    """Deserialise a message.

    Args:
        kind: Its class.
        data: The bytes.

    Raises:
        DeserializationError: They are no such message.
    """
    return kind().deserialize(data)


def copied(kind: type[MessageT], message: MessageT | None) -> MessageT:
    """Return a message's copy with the values that it has on the wire; an empty one of None."""
    return kind() if message is None else unpacked(kind, packed(message))
