"""Tables of models or links that are kept up to date by a topic."""

from __future__ import annotations

import threading
from collections.abc import Iterator, Mapping
from typing import Self

from gazelle.argument_checks import checked
from gazelle.clients.errors import ClientError
from gazelle.clients.poses import ModelState, read_state
from gazelle.errors import did_you_mean
from gazelle_ros import Node
from gazelle_ros.base.closing import Closeable
from gazelle_ros.msgs import gazebo_msgs

_KINDS = ("ModelStates", "LinkStates")


@checked(ClientError, after=True)
class LiveStates(Mapping[str, ModelState], Closeable):
    """States by name, as the last message has them.

    Args:
        node: Listens.
        topic: ``model_states`` or ``link_states``.
        kind: ``ModelStates`` or ``LinkStates``.

    Raises:
        ClientError: There is no such kind.
    """

    def __init__(self, node: Node, topic: str, kind: str) -> None:
        if kind not in _KINDS:
            raise ClientError(f"no states are '{kind}'", hint=did_you_mean(kind, _KINDS))
        self._topic = topic
        self._last: gazebo_msgs.msg.ModelStates | gazebo_msgs.msg.LinkStates | None = None
        self._rows: dict[str, int] = {}
        self._arrived = threading.Event()
        self._subscriber = node.subscribe(topic, getattr(gazebo_msgs.msg, kind), self._receive, 1)

    def wait(self, timeout: float = 10.0) -> Self:
        """Wait for the first message.

        Raises:
            ClientError: None comes within ``timeout`` [s of wall time].
        """
        if not self._arrived.wait(timeout):
            raise ClientError(f"nothing comes on {self._topic} within {timeout:g} s")
        return self

    def close(self) -> None:
        """Unsubscribe."""
        self._subscriber.close()

    def __getitem__(self, name: str) -> ModelState:
        last, rows = self._last, self._rows
        if last is None or name not in rows:
            raise ClientError(f"{self._topic} has no '{name}'", hint=did_you_mean(name, rows))
        return read_state(last.pose[rows[name]], last.twist[rows[name]])

    def __contains__(self, name: object) -> bool:
        return name in self._rows

    def __iter__(self) -> Iterator[str]:
        return iter(self._rows)

    def __len__(self) -> int:
        return len(self._rows)

    def _receive(self, message: gazebo_msgs.msg.ModelStates | gazebo_msgs.msg.LinkStates) -> None:
        if self._last is None or message.name != self._last.name:
            self._rows = {name: row for row, name in enumerate(message.name)}
        self._last = message
        self._arrived.set()
