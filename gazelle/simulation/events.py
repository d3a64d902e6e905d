"""Events of a simulation as a whole, for the interfaces that follow it."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from typing import Any


class Event:
    """Something that happens, and its listeners."""

    def __init__(self) -> None:
        self._listeners: list[Callable[..., Any]] = []

    def subscribe(self, listener: Callable[..., Any]) -> Callable[[], None]:
        """Call a function when it happens; returns what ends it."""
        self._listeners.append(listener)
        return lambda: self._listeners.remove(listener)

    def emit(self, *arguments: object) -> None:
        """Call all listeners."""
        for listener in tuple(self._listeners):
            listener(*arguments)

    def tell(self, *arguments: object) -> None:
        """Call all listeners; deprecated, use `emit`."""
        warnings.warn(DeprecationWarning("Event.tell is called emit now"), stacklevel=2)
        self.emit(*arguments)


class Events:
    """The events of a simulation; listeners run between two steps and may read everything.

    Attributes:
        spawned: A model is there: called with its ``Robot``.
        deleted: A model is gone: called with its ``Robot``.
        reset: Worlds are back in their initial state: called with their indices, or None for
            all, and whether time went back too.
        managed: A model has one more controller manager: called with its ``Robot``, which may not
            be spawned yet.
        rested: A run of steps is over; others may follow at once.
        planned: A motion was planned, or begins to make one, in any thread: called with the
            ``Robot``, the number of the world, and a ``JointMotion``. Planners of users report it too,
            by ``simulation.events.planned.emit(robot, world, motion)``.
    """

    def __init__(self) -> None:
        self.spawned = Event()
        self.deleted = Event()
        self.reset = Event()
        self.managed = Event()
        self.rested = Event()
        self.planned = Event()
