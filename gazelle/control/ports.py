"""Ports of a controller, independent of the interface that uses them.

A port passes plain dataclasses (see ``values`` and ``measurements``), knows of no wire and may be
used from any thread: what comes through it is done between two updates. ROS calls them a subscribed
topic (``CommandPort``), a published one (``StatePort``), a service (``QueryPort``), an action
(``ActionPort``, in ``goals``) and a dynamic_reconfigure server (``TuningPort``).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Generic, Protocol, TypeVar

import numpy as np

from gazelle.argument_checks import checked, world_indices
from gazelle.array_types import Worlds
from gazelle.errors import ControlError, did_you_mean

T = TypeVar("T")
Q = TypeVar("Q")
R = TypeVar("R")


def rows_of(worlds: Worlds | None, nworld: int) -> Worlds:
    """Return indices of worlds, shape (n,); of all if None.

    Raises:
        ControlError: There is no such world, or they are not ints.
    """
    return np.arange(nworld) if worlds is None else world_indices(worlds, nworld, ControlError)


class Serializer(Protocol):
    """Does work between two updates, whichever thread calls, and returns its result."""

    def __call__(self, work: Callable[[], R], /) -> R:
        """Run the work."""


class CommandPort(Generic[T]):
    """A value that a controller acts on when it comes.

    Args:
        topic: Name relative to the manager's namespace, or from the root with a slash.
        kind: Type of the values.
        receive: Gets a value and the worlds it is for; None means all.
        call: Does it between two updates.
        queue_size: Of the topic.

    Attributes:
        publishers: Number of publishers of the topic, where a bridge knows; some controllers refuse
            commands of several.
    """

    def __init__(
        self,
        topic: str,
        kind: type[T],
        receive: Callable[[T, Worlds | None], None],
        call: Serializer,
        *,
        queue_size: int = 1,
    ) -> None:
        self.topic, self.kind, self.queue_size = topic, kind, queue_size
        self.publishers: Callable[[], int] = lambda: 1
        self._receive, self._call = receive, call

    def send(self, value: T, worlds: Worlds | None = None) -> None:
        """Send a value.

        Args:
            value: Of the port's kind.
            worlds: Worlds; all if None.

        Raises:
            ControlError: The controller refuses it: it does not run, or a value is invalid.
        """
        self._call(lambda: self._receive(value, worlds))


class StatePort(Generic[T]):
    """A value that a controller publishes; it costs nothing without subscribers.

    Args:
        topic: As of a ``CommandPort``.
        kind: Type of the values.
        produce: Computes the value now.
        call: Does it between two updates.
        queue_size: Of the topic.
    """

    def __init__(
        self,
        topic: str,
        kind: type[T],
        produce: Callable[[], T],
        call: Serializer,
        *,
        queue_size: int = 1,
    ) -> None:
        self.topic, self.kind, self.queue_size = topic, kind, queue_size
        self._produce, self._call = produce, call
        self._listeners: list[Callable[[T], None]] = []

    @property
    def has_subscribers(self) -> bool:
        """True if there are listeners."""
        return bool(self._listeners)

    @property
    def last(self) -> T:
        """Value that would be published now."""
        return self._call(self._produce)

    def subscribe(self, listener: Callable[[T], None]) -> Callable[[], None]:
        """Call a function with every value published, by the thread that updates.

        Returns:
            What ends it; a second call does nothing.
        """
        self._call(lambda: self._listeners.append(listener))

        def end() -> None:
            if listener in self._listeners:
                self._listeners.remove(listener)

        return lambda: self._call(end)

    def publish(self) -> None:
        """Compute the value and hand it to all subscribers, if there are any."""
        if self._listeners:
            value = self._produce()
            for listener in tuple(self._listeners):
                listener(value)


class QueryPort(Generic[Q, R]):
    """A question that a controller answers.

    Args:
        topic: As of a ``CommandPort``.
        request: Type of the question.
        response: Type of the answer.
        answer: Gets the question; raises ``ControlError`` where there is no answer.
        call: Does it between two updates.
    """

    def __init__(
        self,
        topic: str,
        request: type[Q],
        response: type[R],
        answer: Callable[[Q], R],
        call: Serializer,
    ) -> None:
        self.topic, self.request, self.response = topic, request, response
        self._answer, self._call = answer, call

    def call(self, question: Q) -> R:
        """Return the answer.

        Raises:
            ControlError: There is none.
        """
        return self._call(lambda: self._answer(question))


@checked(ControlError)
@dataclass(frozen=True, slots=True)
class TunableValue:
    """A number or flag of a ``TuningPort``.

    Attributes:
        name: Its name.
        default: Default value; its type is that of all values.
        least: Smallest value.
        most: Largest value.
        description: For people.
    """

    name: str
    default: bool | float
    least: bool | float
    most: bool | float
    description: str = ""

    def clamp(self, value: Any) -> bool | float:
        """Return the nearest allowed value."""
        if isinstance(self.default, bool):
            return bool(value)
        return float(min(max(float(value), self.least), self.most))


class TuningPort:
    """Values that are changed together while a controller runs, in all worlds.

    Args:
        topic: Namespace of the dynamic_reconfigure server, as of a ``CommandPort``.
        tunables: Parameters that can be changed.
        values: Returns the current values, by name.
        change: Called with what is to hold, all of it.
        call: Does it between two updates.
    """

    def __init__(
        self,
        topic: str,
        tunables: Sequence[TunableValue],
        values: Callable[[], Mapping[str, bool | float]],
        change: Callable[[Mapping[str, Any]], None],
        call: Serializer,
    ) -> None:
        self.topic = topic
        self.tunables = {each.name: each for each in tunables}
        self._values, self._change, self._call = values, change, call

    @property
    def values(self) -> dict[str, bool | float]:
        """Current values."""
        return self._call(lambda: dict(self._values()))

    def send(self, /, **requested: Any) -> dict[str, bool | float]:
        """Set some values, each to the nearest allowed one; returns the values in effect.

        Raises:
            ControlError: There is no such value.
        """
        for name in requested:
            if name not in self.tunables:
                raise ControlError(
                    f"'{self.topic}' has no '{name}'", hint=did_you_mean(name, self.tunables)
                )
        clamped = {name: self.tunables[name].clamp(value) for name, value in requested.items()}
        self._call(lambda: self._change({**self._values(), **clamped}))
        return self.values
