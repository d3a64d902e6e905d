"""Robot steering: velocity commands from sliders, as rqt_robot_steering sends them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from gazelle.errors import Error
from gazelle.viewer.graph.context import GraphContext
from gazelle.viewer.graph.panels.panel import GraphPanel
from gazelle_ros.msgs import geometry_msgs

_LINEAR, _ANGULAR = 1.0, 3.0  # [m/s], [rad/s]


class SteeringPanel(GraphPanel):
    """Sends a Twist ten times a second while it is not zero, and zero once at the end.

    Args:
        context: Of the page.
    """

    title = "Robot steering"
    period = 0.1

    def __init__(self, context: GraphContext) -> None:
        super().__init__(context)
        self._publisher: Any = None
        self._moving = False

    def build(self) -> None:
        """Add topic and sliders."""
        gui = self.context.gui
        self._topic: Any = gui.add_text("Topic", "/cmd_vel")
        self._linear: Any = gui.add_slider("Linear [m/s]", -_LINEAR, _LINEAR, 0.01, 0.0)
        self._angular: Any = gui.add_slider("Angular [rad/s]", -_ANGULAR, _ANGULAR, 0.01, 0.0)
        stop = gui.add_button("Stop")
        self.context.on_user_click(stop, self._stop)
        self.context.on_user_change(self._topic, self._advertise)
        self.inputs = {"topic": self._topic}
        self._advertise()

    def use(self, arguments: Sequence[str]) -> None:
        """Take ``--default_topic TOPIC``."""
        words = list(arguments)
        if "--default_topic" in words[:-1]:
            self._topic.value = words[words.index("--default_topic") + 1]
            self._advertise()

    def refresh(self) -> None:
        """Send the sliders' velocity."""
        moving = bool(self._linear.value or self._angular.value)
        if moving or self._moving:
            self._send(self._linear.value, self._angular.value)
        self._moving = moving

    def pause(self) -> None:
        """Stop the robot: no page is open."""
        self._stop()
        self.refresh()

    def close(self) -> None:
        """Stop the robot, and leave the topic."""
        self.pause()
        self._withdraw()

    def _stop(self) -> None:
        self._linear.value = self._angular.value = 0.0

    def _advertise(self) -> None:
        """Publish on the topic of the text."""
        self._withdraw()
        if not self._topic.value:
            raise Error("a robot is steered on a topic", hint="such as /cmd_vel")
        kind = geometry_msgs.msg.Twist
        self._publisher = self.context.node.advertise(self._topic.value, kind, 1)

    def _withdraw(self) -> None:
        if self._publisher is not None:
            self._publisher.close()
            self._publisher = None

    def _send(self, linear: float, angular: float) -> None:
        if self._publisher is not None:
            sent = geometry_msgs.msg.Twist()
            sent.linear.x, sent.angular.z = float(linear), float(angular)
            self._publisher.publish(sent)
