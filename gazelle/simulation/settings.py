"""Values that are set from outside a plugin instead of in its file.

A setting is found once, when its owner joins a graph: a parameter of ROS. A tuning can be
changed at any time: what ROS calls dynamic_reconfigure. Both hold in all worlds, and a reset
leaves them as they are.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, Generic, TypeVar

from gazelle.errors import SimulationError, did_you_mean
from gazelle.simulation.state_lock import StatePart, between_steps
from gazelle_ros.base.tuned_fields import Tunable

T = TypeVar("T")


class Setting(StatePart, Generic[T]):
    """A value that the surroundings may know; its default holds until then.

    Args:
        name: Full name.
        default: Its type is that of all values; ints will do for a float.
        receive: Called with each value that is given. Ports are put on a graph after that,
            and may get other topics here.
        search: Whether a value in a namespace above will do, as of ``/robot_description``.
        awaited: Whether to continue looking for a value until there is one.

    Attributes:
        value: Current value.
    """

    def __init__(
        self,
        name: str,
        default: T,
        receive: Callable[[T], None] | None = None,
        *,
        search: bool = False,
        awaited: bool = False,
    ) -> None:
        self.name, self.search, self.awaited = name, search, awaited
        self.value = default
        self._kind = type(default)
        self._receive = receive

    @between_steps
    def send(self, value: Any) -> None:
        """Set the value.

        Raises:
            SimulationError: It is of another type.
        """
        whole = isinstance(value, int) and not isinstance(value, bool)
        if self._kind is float and whole:
            value = float(value)
        if not isinstance(value, self._kind) or (self._kind is int and not whole):
            raise SimulationError(
                f"'{self.name}' must be of type {self._kind.__name__}, not {value!r}"
            )
        self.value = value
        if self._receive is not None:
            self._receive(value)


class Tuning(StatePart):
    """Values that are changed together while the simulation runs.

    Args:
        topic: Namespace that they are offered in.
        tunables: Parameters that can be changed.
        change: Called with the values that are to hold, all of them.
        values: Returns the current ones, in the same order.
    """

    def __init__(
        self,
        topic: str,
        tunables: Sequence[Tunable],
        change: Callable[[Mapping[str, Any]], None],
        values: Callable[[], Mapping[str, Any]],
    ) -> None:
        self.topic = topic
        self.tunables = {each.name: each for each in tunables}
        self._change = change
        self._values = values

    @property
    @between_steps
    def values(self) -> dict[str, Any]:
        """Current values."""
        return dict(self._values())

    @between_steps
    def send(self, /, **requested: Any) -> dict[str, Any]:
        """Set some values, each to the nearest allowed one; returns the values in effect.

        Raises:
            SimulationError: There is no such value.
        """
        for name in requested:
            if name not in self.tunables:
                raise SimulationError(
                    f"'{self.topic}' has no '{name}'", hint=did_you_mean(name, self.tunables)
                )
        clamped = {name: self.tunables[name].clamp(value) for name, value in requested.items()}
        self._change({**self._values(), **clamped})
        return self.values
