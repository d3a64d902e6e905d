"""Controllers that follow the events of a Kobuki base."""

from __future__ import annotations

import threading
from abc import ABC, abstractmethod

from gazelle_ros.builtin.speeds import repeat
from gazelle_ros.builtin.switching import EnableSwitch
from gazelle_ros.msgs import kobuki_msgs
from gazelle_ros.node import Node

_BUMPER, _CLIFF = kobuki_msgs.msg.BumperEvent, kobuki_msgs.msg.CliffEvent
_WHEEL_DROP = kobuki_msgs.msg.WheelDropEvent
_QUEUE = 10


class KobukiController(ABC):
    """Work at a rate while it is enabled, by the base's events.

    It is enabled at first; ``~enable`` and ``~disable`` change that.

    Args:
        node: On the graph, with ``~events/bumper``, ``~events/cliff`` and ``~events/wheel_drop``.
        hertz: Rate of the work.

    Attributes:
        bumpers: Numbers of the bumpers that are pressed.
        cliffs: Numbers of the sensors that see a cliff.
        wheels: Numbers of the wheels that have dropped.
    """

    def __init__(self, node: Node, hertz: float) -> None:
        self.node = node
        self.bumpers: set[int] = set()
        self.cliffs: set[int] = set()
        self.wheels: set[int] = set()
        self._hertz = hertz
        self._lock = threading.RLock()
        self._switch = EnableSwitch(node)
        node.subscribe("~events/bumper", _BUMPER, self._take_bumper, _QUEUE)
        node.subscribe("~events/cliff", _CLIFF, self._take_cliff, _QUEUE)
        node.subscribe("~events/wheel_drop", _WHEEL_DROP, self._take_wheel, _QUEUE)

    @property
    def enabled(self) -> bool:
        """True while it works."""
        return self._switch.on

    def run(self, stop: threading.Event) -> None:
        """Run until shutdown."""
        repeat(self.node, self._hertz, self.step, stop)

    def step(self) -> None:
        """Run one step, if it is enabled."""
        with self._lock:
            if self.enabled:
                self.work()

    def take(self, sensors: set[int], sensor: int, *, active: bool) -> None:
        """Handle an event.

        Args:
            sensors: `bumpers`, `cliffs` or `wheels`.
            sensor: Number of the one that changes.
            active: Whether it is pressed, sees a cliff, or has dropped.
        """
        with self._lock:
            before = frozenset(sensors)
            (sensors.add if active else sensors.discard)(sensor)
            self.on_event(sensors, before, active=active)

    @abstractmethod
    def work(self) -> None:
        """Publish what the robot is to do now."""

    @abstractmethod
    def on_event(self, sensors: set[int], before: frozenset[int], *, active: bool) -> None:
        """Handle an event, after `sensors` was updated.

        Args:
            sensors: Sensors of its kind that are active.
            before: Those that were active before it.
            active: Whether the sensor of the event became active.
        """

    def _take_bumper(self, message: kobuki_msgs.msg.BumperEvent) -> None:
        self.take(self.bumpers, message.bumper, active=message.state == _BUMPER.PRESSED)

    def _take_cliff(self, message: kobuki_msgs.msg.CliffEvent) -> None:
        self.take(self.cliffs, message.sensor, active=message.state == _CLIFF.CLIFF)

    def _take_wheel(self, message: kobuki_msgs.msg.WheelDropEvent) -> None:
        self.take(self.wheels, message.wheel, active=message.state == _WHEEL_DROP.DROPPED)
