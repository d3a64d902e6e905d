"""The actuators of one robot on the graph; stage_ros has no such topics."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from gazelle.bridges.stage.naming import Naming
from gazelle.ros import Node, load_message
from gazelle.simulation.stage import Actuator, StageRobot, StageSimulation

_QUEUE = 10


class ActuatorTopics:
    """Where actuators are, and what they are told.

    Args:
        simulation: Runs.
        robot: Of it.
        node: On the graph.
        naming: Of topics.
        world: Which world of a batch the graph sees.
    """

    def __init__(
        self,
        simulation: StageSimulation,
        robot: StageRobot,
        node: Node,
        naming: Naming,
        world: int,
    ) -> None:
        self._call, self._world = simulation.requests.call, world
        self._number: Any = load_message("std_msgs/Float64")
        self._own = simulation.devices.actuators.get(robot.index, [])
        count = len(self._own)

        def name(plain: str, which: int) -> str:
            return naming.device_topic(robot.index, plain, which, count)

        self._publishers = [
            node.advertise(name("actuator", k), self._number, _QUEUE) for k in range(count)
        ]
        self._subscribers = [
            node.subscribe(name(f"cmd_actuator_{kind}", k), self._number, told, _QUEUE)
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
                self._call(lambda: act(message.data, worlds))

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
