"""Goals: what takes a controller a while, with news meanwhile and a result at the end.

A goal may be meant for many worlds, and ends in each by itself. The states are actionlib's.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from enum import IntEnum
from typing import Any, Generic, TypeVar

import numpy as np

from gazelle.argument_checks import checked
from gazelle.array_types import Worlds
from gazelle.control.ports import Serializer, rows_of
from gazelle.errors import ControlError

G = TypeVar("G")


class GoalState(IntEnum):
    """States of a goal; the numbers are those of actionlib_msgs/GoalStatus."""

    PENDING = 0
    ACTIVE = 1
    PREEMPTED = 2
    SUCCEEDED = 3
    ABORTED = 4
    REJECTED = 5
    RECALLED = 8


class Goal(Generic[G]):
    """A goal in some worlds.

    Args:
        value: Target.
        worlds: Its worlds, shape (n,).
        port: Port of the goal.

    Attributes:
        value: Target.
        worlds: Its worlds, shape (n,).
        states: State in each of them, ``GoalState``, shape (n,).
        results: Result in each of them, of the port's ``result``; None while there is none.
        text: Latest message, for people.
    """

    def __init__(self, value: G, worlds: Worlds, port: ActionPort[G]) -> None:
        self.value, self.worlds = value, worlds
        self.states = np.full(len(worlds), GoalState.PENDING, np.int8)
        self.results: list[Any] = [None] * len(worlds)
        self.text = ""
        self._port = port
        self._ended = threading.Event()
        self._listeners: list[Callable[[Goal[G]], None]] = []
        self._feedback: list[Callable[[Any], None]] = []

    @property
    def state(self) -> GoalState:
        """State in the first of its worlds."""
        return GoalState(int(self.states[0]))

    @property
    def result(self) -> Any:
        """Result in the first of its worlds; None while there is none."""
        return self.results[0]

    @property
    def done(self) -> bool:
        """True if it has ended in all of its worlds."""
        return bool((self.states > GoalState.ACTIVE).all())

    def wait(self, timeout: float | None = None) -> bool:
        """Wait in wall time until another thread's steps end the goal.

        Args:
            timeout: At most [s].

        Returns:
            Whether it has ended.
        """
        return self._ended.wait(timeout)

    def cancel(self) -> None:
        """Cancel the goal where it is active; the controller holds still then."""
        self._port.cancel(self)

    def subscribe(
        self,
        changed: Callable[[Goal[G]], None],
        feedback: Callable[[Any], None] | None = None,
    ) -> None:
        """Subscribe to changes of state and to feedback.

        Functions are called by the thread that updates.

        Args:
            changed: Gets the goal; called at once with what is.
            feedback: Gets values of the port's ``feedback``, at its ``monitor_rate``.
        """

        def listen() -> None:
            self._listeners.append(changed)
            if feedback is not None:
                self._feedback.append(feedback)
            changed(self)

        self._port.call(listen)

    # -- for controllers -----------------------------------------------------------------

    @property
    def has_feedback_callbacks(self) -> bool:
        """True if there are feedback callbacks."""
        return bool(self._feedback)

    @property
    def watched(self) -> bool:
        """True if there are feedback callbacks or listeners."""
        return bool(self._feedback or self._listeners)

    def publish_feedback(self, value: Any) -> None:
        """Publish feedback."""
        for listener in tuple(self._feedback):
            listener(value)

    def accept(self) -> None:
        """Mark the goal as active in all its worlds."""
        self.states[:] = GoalState.ACTIVE
        self._publish_state()

    def end(
        self, state: GoalState, worlds: Worlds | None = None, result: Any = None, text: str = ""
    ) -> None:
        """Set the goal's terminal state in some worlds, where it has none yet.

        Args:
            state: Final state.
            worlds: Worlds; all if None.
            result: Of the port's kind.
            text: For people.
        """
        here = self.states <= GoalState.ACTIVE
        if worlds is not None:
            here &= np.isin(self.worlds, worlds)
        if not here.any():
            return
        self.states[here] = state
        for index in np.flatnonzero(here):
            self.results[index] = result
        self.text = text
        self._publish_state()
        if self.done:
            self._ended.set()

    def _publish_state(self) -> None:
        for listener in tuple(self._listeners):
            listener(self)


@checked(ControlError, after=True)
class ActionPort(Generic[G]):
    """Takes goals: what ROS calls an action server.

    Args:
        topic: Name relative to the manager's namespace.
        kind: Type of goals.
        feedback: Type of what is said on the way.
        result: Type of what comes out.
        begin: Takes a goal: calls its ``accept``, or its ``end`` with ``REJECTED``.
        stop: Ends a goal on demand.
        nworld: Number of worlds.
        call: Does it between two updates.
        monitor_rate: Of feedback [Hz].
    """

    def __init__(
        self,
        topic: str,
        kind: type[G],
        feedback: type,
        result: type,
        *,
        begin: Callable[[Goal[G]], None],
        stop: Callable[[Goal[G]], None],
        nworld: int,
        call: Serializer,
        monitor_rate: float = 20.0,
    ) -> None:
        self.topic, self.kind, self.feedback, self.result = topic, kind, feedback, result
        self.monitor_rate = monitor_rate
        self.call = call
        self._begin, self._stop, self._nworld = begin, stop, nworld

    def send(self, value: G, worlds: Worlds | None = None) -> Goal[G]:
        """Send a goal; it replaces the active one in these worlds.

        Args:
            value: Target.
            worlds: Worlds; all if None.

        Returns:
            The goal: ``ACTIVE`` or ended when this returns. One that is ``REJECTED`` has a text.

        Raises:
            ControlError: There is no such world.
        """
        goal = Goal(value, rows_of(worlds, self._nworld), self)
        self.call(lambda: self._begin(goal))
        return goal

    def cancel(self, goal: Goal[G]) -> None:
        """Cancel a goal where it is active."""
        self.call(lambda: self._stop(goal))
