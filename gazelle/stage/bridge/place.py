"""Context of one robot on a graph: its node, its names, and the world that the graph sees."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from gazelle.stage import StageFleet, StageRobot
from gazelle.stage.bridge.naming import Naming
from gazelle_ros import Node, Publisher, Subscriber
from gazelle_ros.messages import Message

_QUEUE = 10


@dataclass(frozen=True, slots=True)
class GraphRobot:
    """A robot of a simulation on a graph.

    Attributes:
        simulation: All robots.
        robot: One of them.
        node: On the graph.
        naming: Of topics and frames.
        world: World of a batch that the graph uses.
    """

    simulation: StageFleet
    robot: StageRobot
    node: Node
    naming: Naming
    world: int

    def advertise(
        self, name: str, kind: type[Message], which: int = 0, count: int = 1
    ) -> Publisher:
        """Publish on a topic, of the device of a number if the robot has several of its kind."""
        return self.node.advertise(self._topic(name, which, count), kind, _QUEUE)

    def subscribe(
        self,
        name: str,
        kind: type[Message],
        callback: Callable[[Any], None],
        which: int = 0,
        count: int = 1,
    ) -> Subscriber:
        """Subscribe to a topic; its name is found as ``advertise`` finds it."""
        return self.node.subscribe(self._topic(name, which, count), kind, callback, _QUEUE)

    def frame(self, name: str, which: int = 0, count: int = 1) -> str:
        """Return a frame of the robot, or of one of several devices."""
        return self.naming.frame(self.robot.index, name, which, count)

    def _topic(self, name: str, which: int, count: int) -> str:
        return self.naming.device_topic(self.robot.index, name, which, count)
