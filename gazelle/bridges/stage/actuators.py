"""The actuators of one robot on the graph; stage_ros has no such topics."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from gazelle.bridges.stage.place import GraphRobot
from gazelle.ros import load_message
from gazelle.simulation.stage import Actuator


class ActuatorTopics:
    """Topics of actuators: positions and commands.

    Args:
        at: The robot on the graph.
    """

    def __init__(self, at: GraphRobot) -> None:
        self._lock, self._world = at.simulation.lock, at.world
        self._number: Any = load_message("std_msgs/Float64")
        self._own = at.simulation.devices.actuators.get(at.robot.index, [])
        count = len(self._own)
        self._publishers = [at.advertise("actuator", self._number, k, count) for k in range(count)]
        self._subscribers = [
            at.subscribe(f"cmd_actuator_{kind}", self._number, told, k, count)
            for k, each in enumerate(self._own)
            for kind, told in (
                ("speed", self._told(each.set_speed)),
                ("position", self._told(each.go_to)),
            )
        ]

    def _told(self, act: Callable[[float, Any], None]) -> Callable[[Any], None]:
        worlds = np.array([self._world])

        def told(message: Any) -> None:
            if math.isfinite(message.data):
                with self._lock:
                    act(message.data, worlds)

        return told

    def publish(self) -> None:
        """Publish what is listened to."""
        for publisher, actuator in zip(self._publishers, self._own, strict=True):
            if publisher.has_listener:
                publisher.publish(self._number(self._position(actuator)))

    def _position(self, actuator: Actuator) -> float:
        return float(actuator.position[self._world])

    def close(self) -> None:
        """Publish and hear no more."""
        for publisher in self._publishers:
            publisher.close()
        for subscriber in self._subscribers:
            subscriber.close()
