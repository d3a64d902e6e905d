"""The nodelet ``kobuki_safety_controller``: retreat from what the base touches (http://wiki.ros.org/kobuki_safety_controller)."""

from __future__ import annotations

import logging
from dataclasses import dataclass

from gazelle_ros.builtin.kobuki.controller import KobukiController
from gazelle_ros.builtin.parameters import settings_of
from gazelle_ros.builtin.speeds import Speeds, twist_of
from gazelle_ros.clock import SECOND
from gazelle_ros.msgs import geometry_msgs, kobuki_msgs, std_msgs
from gazelle_ros.node import Node

_HERTZ = 10.0
_STAY: Speeds = (0.0, 0.0)
_SENSORS = kobuki_msgs.msg.BumperEvent  # those of CliffEvent have the same numbers
_RETREATS: dict[int, Speeds] = {
    _SENSORS.CENTER: (-0.1, 0.0),
    _SENSORS.LEFT: (-0.1, -0.4),
    _SENSORS.RIGHT: (-0.1, 0.4),
}
"""Speeds by the sensor, the most important one first."""
_LOG = logging.getLogger("gazelle.ros.kobuki_safety_controller")


@dataclass(frozen=True, slots=True)
class SafetySettings:
    """Parameters of ``kobuki_safety_controller``.

    Attributes:
        time_to_extend_bump_cliff_events: For how long after a bump or cliff began the robot
            retreats at least [s].
    """

    time_to_extend_bump_cliff_events: float = 0.0


class KobukiSafety(KobukiController):
    """Commands on ``~cmd_vel`` while a bumper is pressed, a cliff is seen, or a wheel has dropped.

    A message on ``~reset`` forgets all of these.

    Args:
        node: On the graph.

    Raises:
        Error: A parameter is of another kind.
    """

    def __init__(self, node: Node) -> None:
        self.settings = settings_of(node, SafetySettings)
        self._last: Speeds | None = None
        self._until = 0
        self._output = node.advertise("~cmd_vel", geometry_msgs.msg.Twist, queue_size=10)
        super().__init__(node, _HERTZ)
        node.subscribe("~reset", std_msgs.msg.Empty, self._reset, 10)

    def work(self) -> None:
        """Publish a command, if there is a reason."""
        found = self._command()
        if found is not None:
            self._output.publish(twist_of(found))

    def on_event(self, sensors: set[int], before: frozenset[int], *, active: bool) -> None:
        """Note the time of a bump or cliff."""
        del before
        if active and sensors is not self.wheels:
            seconds = self.settings.time_to_extend_bump_cliff_events
            self._until = self.node.clock.now() + round(seconds * SECOND)

    def _command(self) -> Speeds | None:
        if self.wheels:
            self._last = _STAY
            return self._last
        touched = self.bumpers | self.cliffs
        for sensor, speeds in _RETREATS.items():
            if sensor in touched:
                self._last = speeds
                return self._last
        return self._last if self.node.clock.now() < self._until else None

    def _reset(self, _message: std_msgs.msg.Empty) -> None:
        with self._lock:
            for each in (self.bumpers, self.cliffs, self.wheels):
                each.clear()
        _LOG.warning("all states of bumpers, cliffs and wheels were reset")
