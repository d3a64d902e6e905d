"""Joint sliders: positions for joints without sensors, as joint_state_publisher_gui has them."""

from __future__ import annotations

import math
from functools import partial
from typing import Any

from gazelle.viewer.graph.context import GraphContext
from gazelle.viewer.graph.panels.panel import GraphPanel
from gazelle_ros.msgs import sensor_msgs
from gazelle_ros.names import namespace_of
from gazelle_ros.robot.joint_publisher import limits_of, rest_position
from gazelle_ros.robot.tree import MOVABLE, TreeJoint, read_joints

_SUFFIX = "/sliders"
_DESCRIPTION = "robot_description"
_STEPS = 1000


class JointSlidersPanel(GraphPanel):
    """Publishes the position of a joint when its slider is moved.

    Args:
        context: Of the page.
    """

    title = "Joint sliders"

    def __init__(self, context: GraphContext) -> None:
        super().__init__(context)
        self._publisher: Any = None
        self._text = ""
        self._sliders: dict[str, Any] = {}

    def build(self) -> None:
        """Add the topic; sliders follow when the robot is known."""
        gui = self.context.gui
        self._topic: Any = gui.add_text("Topic", "", hint="That of joint_state_publisher_gui")
        self._hint: Any = gui.add_markdown("No joint_state_publisher_gui runs.")
        self.context.on_user_change(self._topic, self._advertise)
        self.inputs = {"topic": self._topic}

    def refresh(self) -> None:
        """Find the node whose joints have sliders, and its robot."""
        if not self._topic.value:
            _, subscribed, _ = self.context.node.master.system_state()
            self._topic.value = next((each for each in subscribed if each.endswith(_SUFFIX)), "")
        if self._publisher is None and self._topic.value:
            self._advertise()
        text = self._description()
        if text != self._text:
            self._text = text
            self._renew()

    def close(self) -> None:
        """Leave the topic."""
        if self._publisher is not None:
            self._publisher.close()
            self._publisher = None

    def _description(self) -> str:
        """Return the description nearest to the node, as it finds it."""
        name = self._topic.value.removesuffix(_SUFFIX)
        while name not in {"", "/"}:
            space = namespace_of(name)
            found = self.context.node.get_param(f"{space}{_DESCRIPTION}", None)
            if isinstance(found, str):
                return found
            name = space.rstrip("/")
        return ""

    def _renew(self) -> None:
        """Make the sliders of another robot."""
        for each in self._sliders.values():
            each.remove()
        joints = read_joints(self._text) if self._text else {}
        self._sliders = {
            name: self._slider(joint)
            for name, joint in joints.items()
            if joint.kind in MOVABLE and joint.mimic is None
        }
        self._hint.visible = not self._sliders

    def _slider(self, joint: TreeJoint) -> Any:
        low, high = limits_of(joint)
        if not (math.isfinite(high - low) and low < high):
            low, high = -math.pi, math.pi
        value = min(max(rest_position(joint), low), high)
        slider: Any = self.context.gui.add_slider(
            joint.name, low, high, (high - low) / _STEPS, value
        )
        self.context.on_user_change(slider, partial(self._send, joint.name))
        return slider

    def _send(self, name: str) -> None:
        if self._publisher is not None:
            value = float(self._sliders[name].value)
            self._publisher.publish(sensor_msgs.msg.JointState(name=[name], position=[value]))

    def _advertise(self) -> None:
        """Publish on the topic of the text."""
        self.close()
        if self._topic.value:
            kind = sensor_msgs.msg.JointState
            self._publisher = self.context.node.advertise(self._topic.value, kind, 10)
