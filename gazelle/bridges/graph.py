"""A simulation, a node, and the time as the graph sees it."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Protocol

from gazelle_ros import Node, Time
from gazelle_ros.clock import SECOND

if TYPE_CHECKING:
    from gazelle.simulation import Simulation


class TimedGraph(Protocol):
    """A node for something that has a time of its own: a simulation, or a robot.

    Attributes:
        node: On the graph.
        world: World of the batch that the graph uses.
    """

    node: Node
    world: int

    def now(self) -> Time:
        """Return the time."""

    def stamp(self, nanoseconds: int, /) -> Time:
        """Return a time of the source [ns] as a time of the graph."""

    def own_ns(self, time: Time, /) -> int:
        """Return a time of the graph as a time of the source [ns]."""

    def post(self, work: Callable[[], Any], /) -> object:
        """Call a function when nothing is being computed, without waiting for it."""


class Graph:
    """Common base of everything that puts a simulation on a ROS graph.

    Args:
        simulation: Runs.
        node: On the graph.
        world: World of the batch that the graph uses.
        monotonic: Let the graph's time never go back: after a reset it continues from where it
            was.
    """

    def __init__(
        self, simulation: Simulation, node: Node, world: int = 0, *, monotonic: bool = False
    ) -> None:
        self.simulation = simulation
        self.node = node
        self.world = world
        self._monotonic = monotonic
        self._offset_ns = 0
        self._last_ns = 0

    def now(self) -> Time:
        """Return the simulated time."""
        return self.stamp(self.simulation.clock.now_ns)

    def stamp(self, nanoseconds: int) -> Time:
        """Return a simulated time as a time of the graph."""
        self._last_ns = max(self._last_ns, nanoseconds)
        return Time(nsecs=nanoseconds + self._offset_ns)

    def seconds(self, time: Time) -> float:
        """Return a time of the graph as simulated time [s]."""
        return self.own_ns(time) / SECOND

    def own_ns(self, time: Time) -> int:
        """Return a time of the graph as simulated time [ns]."""
        return time.to_nsec() - self._offset_ns

    def post(self, work: Callable[[], Any]) -> None:
        """Call a function between two steps, without waiting for it."""
        self.simulation.lock.post(work)

    def rewound(self) -> None:
        """Handle a reset of the simulated time."""
        if self._monotonic:
            self._offset_ns += self._last_ns
        self._last_ns = 0
