"""The grippers of one robot on the graph; stage_ros has no such topics."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from gazelle.stage import COMMANDS
from gazelle.stage.bridge.place import GraphRobot
from gazelle_ros import Time
from gazelle_ros.msgs import gazelle_msgs, std_msgs


class GripperTopics:
    """Topics of paddles and lifts: states and commands.

    Args:
        at: The robot on the graph.
    """

    def __init__(self, at: GraphRobot) -> None:
        self._simulation, self._robot, self._world = at.simulation, at.robot, at.world
        self._frame = at.frame("base_link")
        self._state = gazelle_msgs.msg.Gripper
        text = std_msgs.msg.String
        count = len(at.simulation.devices.grippers.get(at.robot.index, ()))
        self._publishers = [at.advertise("gripper", self._state, k, count) for k in range(count)]
        self._subscribers = [
            at.subscribe("cmd_gripper", text, self._command(k), k, count) for k in range(count)
        ]

    def _command(self, which: int) -> Callable[[std_msgs.msg.String], None]:
        worlds = np.array([self._world])

        def receive(message: std_msgs.msg.String) -> None:
            word = message.data.strip().lower()
            if word in COMMANDS:
                with self._simulation.lock:
                    self._simulation.gripper(self._robot.name, which).do(word, worlds)

        return receive

    def publish(self, stamp: Time) -> None:
        """Publish the topics with subscribers."""
        for which, publisher in enumerate(self._publishers):
            if publisher.has_subscribers:
                state = self._simulation.gripper(self._robot.name, which).state(self._world)
                message = self._state()
                message.header.stamp, message.header.frame_id = stamp, self._frame
                message.paddles, message.lift = state.paddles, state.lift
                message.beams, message.carried = list(state.beams), state.carried or ""
                publisher.publish(message)

    def close(self) -> None:
        """Stop publishing and subscribing."""
        for publisher in self._publishers:
            publisher.close()
        for subscriber in self._subscribers:
            subscriber.close()
