"""Named inputs and outputs of drives, sensors and controllers.

A port passes plain values and is independent of transports: a ROS bridge binds it to a topic, an
environment reads it as arrays, Python reads it as values. Its values are plain
dataclass (see ``values``, ``gazelle.sensors``) or a bool, an int, a float or a str. An output
costs nothing without subscribers.
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Mapping
from enum import Enum
from types import MappingProxyType
from typing import Any, Generic, NoReturn, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gazelle.argument_checks import checked
from gazelle.array_types import Floats, Worlds
from gazelle.engines.limits import MAX_WORLDS, integer
from gazelle.errors import SimulationError, UnknownNameError, did_you_mean
from gazelle.simulation.inputs import chosen, size_of
from gazelle.simulation.settings import Setting, Tuning
from gazelle.simulation.state_lock import StateLock, StatePart, between_steps

T = TypeVar("T")
Q = TypeVar("Q")
R = TypeVar("R")


class TwistInput(StatePart):
    """Velocity commands for a base: forward is x, left is y, counter-clockwise is positive.

    The last command holds until the next, as in Gazebo.

    Args:
        nworld: Number of worlds.
        topic: Topic name from the file.

    Raises:
        EngineError: The number of worlds is invalid.

    Attributes:
        steers: Whether it takes turning for the angle of steered wheels [rad], not for a rate.
    """

    steers = False

    def __init__(self, nworld: int, topic: str) -> None:
        nworld = integer("the number of worlds", nworld, 1, MAX_WORLDS)
        self.topic = topic
        self._revision = np.zeros(1, np.int64)
        self.linear: Floats = np.zeros((nworld, 3))
        self.angular: Floats = np.zeros((nworld, 3))

    @property
    def revision(self) -> int:
        """Counts commands, so that a drive sees that there is a new one."""
        return int(self._revision[0])

    def store_in(
        self, linear: Floats, angular: Floats, revision: NDArray[np.int64] | None = None
    ) -> None:
        """Store commands in other arrays from now on, such as columns of a system.

        Args:
            linear: Shape (nworld, 3).
            angular: Likewise.
            revision: For the count of commands, shape (1,).

        Raises:
            SimulationError: An array has another shape.
        """
        if not linear.shape == angular.shape == self.linear.shape:
            raise SimulationError(f"commands are kept in arrays of shape {self.linear.shape}")
        linear[:], angular[:] = self.linear, self.angular
        self.linear, self.angular = linear, angular
        if revision is not None:
            revision[:] = self._revision
            self._revision = revision

    def keep_in(
        self, linear: Floats, angular: Floats, revision: NDArray[np.int64] | None = None
    ) -> None:
        """Store commands in other arrays; deprecated, use `store_in`."""
        warnings.warn(DeprecationWarning("TwistInput.keep_in is called store_in now"), stacklevel=2)
        self.store_in(linear, angular, revision)

    @between_steps
    def send(
        self,
        linear: ArrayLike = 0.0,
        angular: ArrayLike = 0.0,
        worlds: Worlds | None = None,
    ) -> None:
        """Command a velocity.

        Args:
            linear: Forward velocity [m/s], shape () or (n,), or vectors, shape (n, 3); of one
                world a vector may be (3,).
            angular: Turning rate about z [rad/s], likewise.
            worlds: Worlds; all if None.

        Raises:
            SimulationError: A value is not a number, not finite, or of another shape.
        """
        some = chosen(worlds, len(self.linear))
        rows: slice | Worlds = slice(None) if some is None else some
        count = size_of(some, len(self.linear))
        forward, turning = self._checked(linear, count), self._checked(angular, count)
        for command, values, axis in ((self.linear, forward, 0), (self.angular, turning, 2)):
            if values.ndim > 1 or (count == 1 and values.shape == (3,)):
                command[rows] = values
            else:
                command[rows] = 0.0
                command[rows, axis] = values
        self._revision[0] += 1  # several times faster than writing the whole array

    def _checked(self, given: ArrayLike, count: int) -> Floats:
        """Return numbers or vectors of a given number of worlds."""
        try:
            values = np.asarray(given, np.float64)
        except (TypeError, ValueError, OverflowError):
            raise SimulationError(
                f"the command on '{self.topic}' must be numbers, not {given!r}"
            ) from None
        # The sum of squares is finite if all values are, in one pass; very large values are checked below.
        flat = values.reshape(-1)
        if not math.isfinite(flat.dot(flat)) and not np.isfinite(values).all():
            raise SimulationError(f"the command on '{self.topic}' is not finite: {values}")
        if values.shape == (count,):
            return values
        vectors = values.shape in ((count, 3), (1, 3)) or (values.shape == (3,) and count == 1)
        if not vectors and values.shape not in ((), (1,)):
            worlds = "" if count == 1 else f", one for each of {count} worlds"
            raise SimulationError(
                f"the command on '{self.topic}' must be a number{worlds}, or three, not of "
                f"shape {values.shape}",
                hint=f"vectors of {count} worlds have the shape ({count}, 3)",
            )
        return values

    @between_steps
    def clear(self, worlds: Worlds | None = None) -> None:
        """Discard the last command: stop."""
        some = chosen(worlds, len(self.linear))
        rows: slice | Worlds = slice(None) if some is None else some
        self.linear[rows] = 0.0
        self.angular[rows] = 0.0
        self._revision += 1


class Input(StatePart, Generic[T]):
    """A value that a plugin acts on when it comes.

    Args:
        topic: Topic name from the file.
        kind: Type of the values.
        receive: Gets a value and the worlds it is for; None means all.
        forget: Called at a reset with the worlds; to put back what a value changed.
        queue_size: Of the topic.
    """

    def __init__(
        self,
        topic: str,
        kind: type[T],
        receive: Callable[[T, Worlds | None], None],
        *,
        forget: Callable[[Worlds | None], None] | None = None,
        queue_size: int = 10,
    ) -> None:
        self.topic = topic
        self.kind = kind
        self.queue_size = queue_size
        self._receive = receive
        self._forget = forget

    @between_steps
    def send(self, value: T, worlds: Worlds | None = None) -> None:
        """Send a value to the port.

        Args:
            value: Of the port's kind.
            worlds: Worlds; all if None.
        """
        self._receive(value, self._some(worlds))

    @between_steps
    def clear(self, worlds: Worlds | None = None) -> None:
        """Discard the last value."""
        if self._forget is not None:
            self._forget(self._some(worlds))


class Service(StatePart, Generic[Q, R]):
    """A question that a plugin answers.

    Args:
        topic: Name from the file.
        request: Type of the question; None for an empty one.
        response: Type of the answer; None for an empty one.
        answer: Gets the question and the worlds it is for; None means all.
    """

    def __init__(
        self,
        topic: str,
        request: type[Q] | None,
        response: type[R] | None,
        answer: Callable[[Q, Worlds | None], R],
    ) -> None:
        self.topic = topic
        self.request = request
        self.response = response
        self._answer = answer

    @between_steps
    def call(self, request: Q, worlds: Worlds | None = None) -> R:
        """Call the service.

        Args:
            request: Of the service's request type, or None.
            worlds: Worlds; all if None.
        """
        return self._answer(request, self._some(worlds))


class FramePrefix(Enum):
    """Prefix that a graph puts before the names of frames; Gazebo's plugins differ in it."""

    NEAREST = "tf_prefix of the namespace, or of the nearest above it that has one"
    OWN = "tf_prefix of the namespace itself"
    NAMESPACE = "the namespace; the root's tf_prefix if it is the root"
    NONE = "nothing"


class Output(StatePart, Generic[T]):
    """A value that is published at a rate.

    Args:
        topic: Topic name from the file.
        kind: Type of the values.
        produce: Computes the value now.
        frame: Frame of the values, for kinds without one.
        queue_size: Of the topic.
        latch: Whether late subscribers get the last value.
        namespace: Namespace of the frames; that of the topic if None.
        prefix: Prefix of the names of its frames on a graph.
        event: Whether it publishes events, and nothing at other times.
    """

    def __init__(
        self,
        topic: str,
        kind: type[T],
        produce: Callable[[], T],
        *,
        frame: str = "",
        queue_size: int = 1,
        latch: bool = False,
        namespace: str | None = None,
        prefix: FramePrefix = FramePrefix.NEAREST,
        event: bool = False,
    ) -> None:
        self.topic = topic
        self.kind = kind
        self.frame = frame
        self.namespace = namespace
        self.prefix = prefix
        self.event = event
        self.queue_size = queue_size
        self.latch = latch
        self._produce = produce
        self._last: T | None = None
        self._listeners: list[Callable[[T], None]] = []

    @property
    def has_subscribers(self) -> bool:
        """True if there are subscribers."""
        return bool(self._listeners)

    @property
    def wanted(self) -> bool:
        """True if there are subscribers; deprecated, use `has_subscribers`."""
        warnings.warn(
            DeprecationWarning("Output.wanted is called has_subscribers now"), stacklevel=2
        )
        return self.has_subscribers

    @property
    @between_steps
    def last(self) -> T:
        """Value that was published last; without subscribers, the one that would be published now."""
        if self._last is None or not self._listeners:
            return self._produce()
        return self._last

    @between_steps
    def subscribe(self, listener: Callable[[T], None]) -> Callable[[], None]:
        """Call a function with every value published; returns what ends it."""
        self._listeners.append(listener)
        self._note()
        return lambda: self._end(listener)

    @between_steps
    def _end(self, listener: Callable[[T], None]) -> None:
        self._listeners.remove(listener)
        self._note()

    def _note(self) -> None:
        """Report a change of subscribers to the step loop."""
        if self._lock is not None:
            self._lock.changes += 1

    @between_steps
    def publish(self) -> None:
        """Compute the value and hand it to all subscribers, if there are any."""
        if self._listeners:
            self.publish_computed(self._produce())

    @between_steps
    def publish_computed(self, value: T) -> None:
        """Publish a value that was computed already."""
        self._last = value
        for listener in tuple(self._listeners):
            listener(value)

    @between_steps
    def forget(self) -> None:
        """Discard the last value; after a reset ``last`` is computed again."""
        self._last = None


class PortTable(dict[str, T]):
    """Ports by name. One that takes the name of another leaves that one ``NAME 2``, ``NAME 3``...

    A model may have two plugins of a kind, such as a drive for each pair of wheels.

    Args:
        lock: Of the simulation that the ports belong to from then on.
    """

    def __init__(self, lock: StateLock | None = None) -> None:
        super().__init__()
        self._lock = lock

    def __setitem__(self, name: str, port: T) -> None:
        """Add a port."""
        if name in self:
            number = 2
            while f"{name} {number}" in self:
                number += 1
            super().__setitem__(f"{name} {number}", self[name])
        if isinstance(port, StatePart):
            port.bind(self._lock)
        super().__setitem__(name, port)

    def __missing__(self, name: str) -> NoReturn:
        """Raise an error that lists the known names.

        Raises:
            UnknownNameError: There is no port of this name.
        """
        raise UnknownNameError(f"there is no '{name}' here", hint=did_you_mean(name, self))

    def update(self, ports: Mapping[str, T] = MappingProxyType({}), /, **more: T) -> None:  # type: ignore[override]
        """Add ports; a dict's own would not set their simulation."""
        for name, port in {**ports, **more}.items():
            self[name] = port


class Ports:
    """Ports of one owner, by names that do not change with topics.

    Attributes:
        inputs: Ports that take commands.
        outputs: Ports that publish.
        services: Ports that answer.
        settings: Values that are found around it.
        tunings: Values that can be changed while it runs.

    Args:
        lock: Of the simulation; what comes through the ports from other threads is done
            between two steps.
        namespace: Put before topics.
    """

    def __init__(self, lock: StateLock | None = None, namespace: str = "") -> None:
        self.namespace = namespace
        self.inputs: dict[str, Any] = PortTable(lock)
        self.outputs: dict[str, Output[Any]] = PortTable(lock)
        self.services: dict[str, Service[Any, Any]] = PortTable(lock)
        self.settings: dict[str, Setting[Any]] = PortTable(lock)
        self.tunings: dict[str, Tuning] = PortTable(lock)

    def mark(self) -> tuple[Mapping[str, Any], ...]:
        """Return the present ports, for ``back_to``."""
        return tuple(dict(table) for table in self._tables())

    @checked(SimulationError, after=True)
    def back_to(self, mark: tuple[Mapping[str, Any], ...]) -> None:
        """Close all ports that were opened after a mark was taken."""
        for table, before in zip(self._tables(), mark, strict=True):
            table.clear()
            table.update(before)

    def _tables(self) -> tuple[dict[str, Any], ...]:
        return (self.inputs, self.outputs, self.services, self.settings, self.tunings)
