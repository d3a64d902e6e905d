"""Sliders that send joint trajectories, as rqt_joint_trajectory_controller."""

from __future__ import annotations

import math
import threading
from typing import Any

from gazelle.viewer.graph.context import GraphContext
from gazelle.viewer.graph.panels.panel import GraphPanel
from gazelle_ros import Duration
from gazelle_ros.msgs import control_msgs, trajectory_msgs

_NONE = "choose ..."
_LEAST_S = 0.3  # of a motion


class JointTrajectoryPanel(GraphPanel):
    """A slider for each joint of a joint_trajectory_controller.

    Sliders follow the robot until *Send* is ticked; then each change is sent as a trajectory of
    one point.

    Args:
        context: Of the page.
    """

    title = "Joint trajectory"
    period = 0.2

    def __init__(self, context: GraphContext) -> None:
        super().__init__(context)
        self._lock = threading.Lock()
        self._state: control_msgs.msg.JointTrajectoryControllerState | None = None
        self._subscriber: Any = None
        self._publisher: Any = None
        self._sliders: dict[str, Any] = {}
        self._sent: dict[str, float] = {}
        self._controller = _NONE

    def build(self) -> None:
        """Add the choice of a controller."""
        gui = self.context.gui
        self._chosen: Any = gui.add_dropdown("Controller", (_NONE,))
        self._send: Any = gui.add_checkbox("Send", initial_value=False)
        self._speed: Any = gui.add_number("Speed [rad/s]", 0.5, min=0.01, max=5.0, step=0.05)
        self._folder: Any = gui.add_folder("Joints", visible=False)

    def refresh(self) -> None:
        """List controllers, move the sliders, and send what the user changed."""
        kind = "control_msgs/JointTrajectoryControllerState"
        types = self.context.node.master.topic_types()
        names = sorted(topic.removesuffix("/state") for topic, each in types if each == kind)
        if tuple(self._chosen.options) != (_NONE, *names):
            self._chosen.options = (_NONE, *names)
        if self._chosen.value != self._controller:
            self._follow(self._chosen.value)
        with self._lock:
            state = self._state
        if state is None:
            return
        actual = dict(zip(state.joint_names, state.actual.positions, strict=False))
        if list(self._sliders) != list(actual):
            self._build(actual)
        if self._send.value:
            self._command(actual)
        else:
            for name, value in actual.items():
                slider = self._sliders[name]
                slider.value = round(min(max(value, slider.min), slider.max), 3)
            self._sent = self._wanted()

    def pause(self) -> None:
        """Send nothing while no page is open."""
        self._send.value = False

    def close(self) -> None:
        """Leave the controller."""
        self._follow(_NONE)

    def _follow(self, controller: str) -> None:
        for each in (self._subscriber, self._publisher):
            if each is not None:
                each.close()
        self._subscriber = self._publisher = self._state = None
        self._controller, self._send.value = controller, False
        self._folder.visible = controller != _NONE
        if controller != _NONE:
            node, messages = self.context.node, control_msgs.msg
            kind = messages.JointTrajectoryControllerState
            self._subscriber = node.subscribe(f"{controller}/state", kind, self._take, 1)
            command = trajectory_msgs.msg.JointTrajectory
            self._publisher = node.advertise(f"{controller}/command", command, 1)

    def _take(self, state: control_msgs.msg.JointTrajectoryControllerState) -> None:
        with self._lock:
            self._state = state

    def _build(self, actual: dict[str, float]) -> None:
        for slider in self._sliders.values():
            slider.remove()
        with self._folder:
            self._sliders = {}
            for name, value in actual.items():
                low, high = self._limits(name)
                start = round(min(max(value, low), high), 3)
                self._sliders[name] = self.context.gui.add_slider(name, low, high, 0.001, start)

    def _limits(self, joint: str) -> tuple[float, float]:
        """Return the limits of a joint by its description, a turn without any [m or rad]."""
        for robot in self.context.robots.values():
            for each in robot.model.joints:
                if each.name == joint and each.axes:
                    low, high = each.axes[0].lower, each.axes[0].upper
                    if math.isfinite(low) and math.isfinite(high) and high > low:
                        return low, high
        return -math.pi, math.pi

    def _wanted(self) -> dict[str, float]:
        return {name: float(slider.value) for name, slider in self._sliders.items()}

    def _command(self, actual: dict[str, float]) -> None:
        """Send the sliders' positions if the user moved one."""
        targets = self._wanted()
        if targets == self._sent or self._publisher is None:
            return
        self._sent = targets
        farthest = max(abs(targets[name] - actual[name]) for name in targets)
        seconds = max(farthest / self._speed.value, _LEAST_S)
        point = trajectory_msgs.msg.JointTrajectoryPoint(
            positions=list(targets.values()), time_from_start=Duration.from_sec(seconds)
        )
        sent = trajectory_msgs.msg.JointTrajectory(joint_names=list(targets), points=[point])
        self._publisher.publish(sent)
