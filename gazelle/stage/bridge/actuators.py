"""The actuators of one robot on the graph; stage_ros has no such topics."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from gazelle.array_types import Worlds
from gazelle.stage import Actuator
from gazelle.stage.bridge.place import GraphRobot
from gazelle_ros.msgs import std_msgs


class ActuatorTopics:
    """Topics of actuators: positions and commands.

    Args:
        at: The robot on the graph.
    """

    def __init__(self, at: GraphRobot) -> None:
        self._simulation, self._robot, self._world = at.simulation, at.robot, at.world
        self._number = std_msgs.msg.Float64
        count = len(at.simulation.devices.actuators.get(at.robot.index, []))
        self._publishers = [at.advertise("actuator", self._number, k, count) for k in range(count)]
        self._subscribers = [
            at.subscribe(f"cmd_actuator_{kind}", self._number, self._command(k, act), k, count)
            for k in range(count)
            for kind, act in (("speed", Actuator.set_speed), ("position", Actuator.go_to))
        ]

    def _actuator(self, which: int) -> Actuator:
        """Return an actuator, which is another object when models came or went."""
        return self._simulation.actuator(self._robot.name, which)

    def _command(
        self, which: int, act: Callable[[Actuator, float, Worlds], None]
    ) -> Callable[[std_msgs.msg.Float64], None]:
        worlds = np.array([self._world])

        def receive(message: std_msgs.msg.Float64) -> None:
            if math.isfinite(message.data):
                with self._simulation.lock:
                    act(self._actuator(which), message.data, worlds)

        return receive

    def publish(self) -> None:
        """Publish the topics with subscribers."""
        for which, publisher in enumerate(self._publishers):
            if publisher.has_subscribers:
                position = self._actuator(which).position[self._world]
                publisher.publish(self._number(float(position)))

    def close(self) -> None:
        """Stop publishing and subscribing."""
        for publisher in self._publishers:
            publisher.close()
        for subscriber in self._subscribers:
            subscriber.close()
