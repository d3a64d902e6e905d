"""Outputs of Stage's robots: values after a step, while there are subscribers."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

from gazelle.simulation.ports import Output
from gazelle.simulation.robot import Robot
from gazelle.simulation.state_lock import between_steps

T = TypeVar("T")


class StepOutput(Output[T]):
    """Published after every step while it has subscribers.

    Args:
        robot: Its robot.
        topic: Topic name.
        kind: Type of the values.
        produce: Computes the value now.
        namespace: Namespace of the frames.
    """

    def __init__(
        self,
        robot: Robot,
        topic: str,
        kind: type[T],
        produce: Callable[[], T],
        namespace: str | None = None,
    ) -> None:
        super().__init__(topic, kind, produce, namespace=namespace)
        self._robot = robot
        self._unsubscribe: Callable[[], None] | None = None

    @between_steps
    def subscribe(self, listener: Callable[[T], None]) -> Callable[[], None]:
        """Call a function with every value published; returns what ends it."""
        end = super().subscribe(listener)
        if self._unsubscribe is None:
            self._unsubscribe = self._robot.simulation.subscribe(self.publish)

        def finish() -> None:
            end()
            if not self.has_subscribers and self._unsubscribe is not None:
                self._unsubscribe()
                self._unsubscribe = None

        return finish
