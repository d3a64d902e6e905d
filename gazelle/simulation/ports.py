"""Named inputs and outputs of drives, sensors and controllers.

A port carries plain values and knows of no door: a ROS bridge binds it to a topic, an
environment reads it as arrays, Python reads it as values. Arrays have a leading axis over
worlds. An output costs nothing while nobody listens.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Generic, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gazelle.errors import SimulationError

Floats = NDArray[np.float64]
Worlds = NDArray[np.intp]
T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Odometry:
    """Where a robot believes to be, in every world.

    Attributes:
        stamp: Simulated time [ns].
        frame: Frame of the pose.
        child_frame: Frame of the twist.
        position: [m], shape (nworld, 3).
        quaternion: (x, y, z, w), shape (nworld, 4).
        linear: Velocity in the child frame [m/s], shape (nworld, 3).
        angular: Angular velocity in the child frame [rad/s], shape (nworld, 3).
    """

    stamp: int
    frame: str
    child_frame: str
    position: Floats
    quaternion: Floats
    linear: Floats
    angular: Floats


@dataclass(frozen=True, slots=True)
class JointStates:
    """Joints by name, in every world.

    Attributes:
        stamp: Simulated time [ns].
        names: Plain joint names.
        position: [m or rad], shape (nworld, joints).
        velocity: [m/s or rad/s], shape (nworld, joints); empty when not measured.
    """

    stamp: int
    names: tuple[str, ...]
    position: Floats
    velocity: Floats


class TwistInput:
    """Velocity commands for a base: forward is x, left is y, counter-clockwise is positive.

    The last command holds until the next, as in Gazebo.

    Args:
        nworld: Number of worlds.
        topic: Topic name that the file asks for.

    Attributes:
        revision: Counts commands, so that a drive sees that there is a new one.
    """

    def __init__(self, nworld: int, topic: str) -> None:
        self.topic = topic
        self.revision = 0
        self.linear: Floats = np.zeros((nworld, 3))
        self.angular: Floats = np.zeros((nworld, 3))

    def send(
        self,
        linear: ArrayLike = 0.0,
        angular: ArrayLike = 0.0,
        worlds: Worlds | None = None,
    ) -> None:
        """Command a velocity.

        Args:
            linear: Forward velocity [m/s], shape () or (n,), or vectors, shape (n, 3).
            angular: Turning rate about z [rad/s], shape () or (n,), or vectors, shape (n, 3).
            worlds: Which worlds; all if None.

        Raises:
            SimulationError: A value is not finite.
        """
        for array, given, axis in ((self.linear, linear, 0), (self.angular, angular, 2)):
            values = np.asarray(given, np.float64)
            if not np.isfinite(values).all():
                raise SimulationError(f"the command on '{self.topic}' is not finite: {values}")
            rows: slice | Worlds = slice(None) if worlds is None else worlds
            if values.ndim == 2:
                array[rows] = values
            else:
                array[rows] = 0.0
                array[rows, axis] = values
        self.revision += 1

    def clear(self, worlds: Worlds | None = None) -> None:
        """Forget the last command: stand still."""
        rows: slice | Worlds = slice(None) if worlds is None else worlds
        self.linear[rows] = 0.0
        self.angular[rows] = 0.0
        self.revision += 1


class Output(Generic[T]):
    """A value that is published at a rate.

    Args:
        topic: Topic name that the file asks for.
        produce: Computes the value now.
    """

    def __init__(self, topic: str, produce: Callable[[], T]) -> None:
        self.topic = topic
        self._produce = produce
        self._last: T | None = None
        self._listeners: list[Callable[[T], None]] = []

    @property
    def wanted(self) -> bool:
        """Whether anybody listens."""
        return bool(self._listeners)

    @property
    def last(self) -> T:
        """What was published last; what would be published now if nobody listens."""
        if self._last is None or not self._listeners:
            return self._produce()
        return self._last

    def subscribe(self, listener: Callable[[T], None]) -> Callable[[], None]:
        """Call a function with every value published; returns what ends it."""
        self._listeners.append(listener)
        return lambda: self._listeners.remove(listener)

    def publish(self) -> None:
        """Compute the value and hand it to all who listen, if anybody does."""
        if self._listeners:
            self._last = self._produce()
            for listener in tuple(self._listeners):
                listener(self._last)
