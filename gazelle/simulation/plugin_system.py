"""Everything of one kind, of all robots in all worlds, updated at once."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, Generic, Protocol, TypeVar

from gazelle.native.system import System

P = TypeVar("P")


class Published(Protocol):
    """An output, or several that are published together."""

    @property
    def has_subscribers(self) -> bool:
        """True while it has subscribers."""

    def publish(self) -> None:
        """Publish a new value to all subscribers."""


@dataclass(frozen=True, slots=True)
class InStepWork:
    """Work of a system that engines do within their steps, for some time.

    Attributes:
        kernels: Updated in each step, in order; none while there is nothing to do.
        until_ns: Time of Python's next update of the system [ns]; infinite for never.
        lasting: Whether this holds, and ``sync`` may wait, until something is done to the system
            (``SystemsInStep.invalidate``). Else the system is queried again after some steps.
    """

    kernels: tuple[System, ...]
    until_ns: float
    lasting: bool = False


class PluginSystem(Generic[P]):
    """Plugins that name one class as their ``system`` and are due together, a row each.

    A system is made of one plugin or of many: there is no other implementation for one robot. It
    is made again when subscribers change, and when models come or go. What is reset, saved and
    restored stays with the plugins, such as in columns of the system's arrays.

    Args:
        plugins: The rows, in the order in which they were loaded; of one simulation.

    Attributes:
        acts: Whether it has an ``update``; False for one that only publishes.
        single: Whether each plugin has a system of its own.
        plugins: The rows.
        kernel: Compiled system with a row for each plugin in each world, which is updated instead
            of ``update``: by engines within their steps where nothing is published; None for none.
    """

    acts: ClassVar[bool] = True
    single: ClassVar[bool] = False

    def __init__(self, plugins: Sequence[P]) -> None:
        self.plugins = tuple(plugins)
        self.kernel: System | None = None

    @property
    def active(self) -> bool:
        """True while ``update`` has anything to do."""
        return self.acts

    def update(self, time: float) -> None:
        """Update all rows; called at the plugins' ``update_rate``.

        Args:
            time: Simulated time [s].
        """

    def in_step(self) -> InStepWork | None:
        """Return what engines do in place of ``update`` from now on; None for nothing.

        Only for a system whose ``kernel`` is not always good; called before steps are made.
        """
        return None

    def sync(self) -> None:
        """Copy the results of ``in_step`` into the plugin."""

    def measure(self, plugins: Sequence[P]) -> Sequence[Any]:
        """Return what ``publish`` gets for some rows, measured at once after ``update``.

        Args:
            plugins: Those with subscribers, at least one.
        """
        return [None] * len(plugins)

    def publish(self, plugin: P, measured: Any) -> None:
        """Publish to the subscribers of one row.

        Args:
            plugin: The row.
            measured: Its part of ``measure``.
        """
        del measured
        for output in getattr(plugin, "published", ()):
            output.publish()


class PublisherSystem(PluginSystem[P]):
    """Plugins that only publish their ``published`` outputs, at their rate."""

    acts = False
