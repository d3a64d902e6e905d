"""Tools of the page: goals, pose estimates, points and distances, as RViz has them."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from gazelle.array_types import Floats
from gazelle.viewer.graph.context import GraphContext
from gazelle.viewer.graph.pointing import GroundPointer, nearest_on_ray
from gazelle_ros.msgs import geometry_msgs, std_msgs

MOVE = "Move camera"
GOAL, ESTIMATE, POINT, MEASURE = "2D Nav Goal", "2D Pose Estimate", "Publish Point", "Measure"
_HINTS = {
    MOVE: "",
    GOAL: "Press where the robot is to go and drag to where it is to look.",
    ESTIMATE: "Press where the robot is and drag to where it looks.",
    POINT: "Click on a point of a scan or cloud, or on the ground.",
    MEASURE: "Drag from one point to the other.",
}
_COLORS = {GOAL: (200, 60, 200), ESTIMATE: (40, 160, 70), POINT: (230, 150, 20), MEASURE: (50, 110, 190)}  # fmt: skip
_SPREAD_M, _SPREAD_RAD = 0.5, math.pi / 12.0  # of a pose that a user points at
_LENGTH_M = 1.0  # of an arrow of a mere click


@dataclass(frozen=True, slots=True)
class _ToolTopic:
    """A tool's topic and type of message."""

    topic: str
    kind: Any


_TARGETS = {
    GOAL: _ToolTopic("/move_base_simple/goal", geometry_msgs.msg.PoseStamped),
    ESTIMATE: _ToolTopic("/initialpose", geometry_msgs.msg.PoseWithCovarianceStamped),
    POINT: _ToolTopic("/clicked_point", geometry_msgs.msg.PointStamped),
}


class PointerTools:
    """The tools of the pointer, and the choice of one.

    Args:
        context: Of the page.
        points: Returns the points that displays show [m], shape (n, 3).

    Attributes:
        tool: The one in use.
    """

    def __init__(self, context: GraphContext, points: Callable[[], Floats]) -> None:
        self._context, self._points = context, points
        self.tool = MOVE
        self._pointer = GroundPointer(context, self._preview, self._use, self._pick)
        self._publishers = {
            name: context.node.advertise(target.topic, target.kind, 1)
            for name, target in _TARGETS.items()
        }
        self._marks: dict[str, list[Any]] = {}
        self._choice: Any = context.gui.add_dropdown("Tool", tuple(_HINTS), initial_value=MOVE)
        self._hint: Any = context.gui.add_markdown("", visible=False)
        context.on_user_change(self._choice, lambda: self.choose(self._choice.value))

    def choose(self, tool: str, said: str = "") -> None:
        """Use another tool.

        Args:
            tool: Its name.
            said: Text below the choice in place of the tool's hint.
        """
        self.tool = tool
        if self._choice.value != tool:
            self._choice.value = tool
        self._pointer.arm(armed=tool != MOVE)
        self._hint.content = said or _HINTS[tool]
        self._hint.visible = bool(self._hint.content)

    def _preview(self, start: Floats, end: Floats) -> None:
        """Draw the tool's arrow or line."""
        scene, tool = self._context.scene, self.tool
        self._clear(tool)
        color, root = _COLORS[tool], f"/tools/{tool}"
        lifted = np.array([0.0, 0.0, 0.02])
        marks: list[Any]
        if tool == POINT:
            marks = [scene.add_icosphere(root, 0.06, color, position=end, cast_shadow=False)]
        elif tool == MEASURE:
            line = np.array([[start, end]], np.float32) + lifted
            text = f"{np.linalg.norm(end - start):.2f} m"
            marks = [
                scene.add_line_segments(
                    root, line, color, thickness=4.0, thickness_units="screen"
                ),
                scene.add_label(f"{root}_label", text, position=(start + end) / 2.0),
            ]  # fmt: skip
        else:
            yaw = _yaw(start, end)
            tip = start + _LENGTH_M * np.array([math.cos(yaw), math.sin(yaw), 0.0])
            marks = [
                scene.add_arrows(
                    root, np.array([[start, tip]]) + lifted, color,
                    shaft_radius=0.04, head_radius=0.1, head_length=0.25,
                )
            ]  # fmt: skip
        self._marks[tool] = marks

    def _pick(self, origin: Floats, direction: Floats) -> Floats | None:
        return nearest_on_ray(origin, direction, self._points()) if self.tool == POINT else None

    def _use(self, start: Floats, end: Floats) -> None:
        self._context.guarded(lambda: self._finish(start, end))

    def _finish(self, start: Floats, end: Floats) -> None:
        """Publish the chosen point or pose, and return the mouse to the camera."""
        tool = self.tool
        if tool == MOVE:
            return
        self._preview(start, end)
        if tool == MEASURE:
            self.choose(tool, f"**{np.linalg.norm(end - start):.3f} m**")
            return
        yaw = _yaw(start, end)
        self._publishers[tool].publish(self._message(tool, start, yaw))
        self.choose(MOVE, _said(_TARGETS[tool].topic, tool, start, yaw))

    def _message(self, tool: str, at: Floats, yaw: float) -> Any:
        header = std_msgs.msg.Header(stamp=self._context.stamp(), frame_id=self._context.fixed)
        x, y, z = at.tolist()
        place = geometry_msgs.msg.Point(x=x, y=y, z=z)
        if tool == POINT:
            return geometry_msgs.msg.PointStamped(header=header, point=place)
        turn = geometry_msgs.msg.Quaternion(z=math.sin(yaw / 2.0), w=math.cos(yaw / 2.0))
        pose = geometry_msgs.msg.Pose(position=place, orientation=turn)
        if tool == GOAL:
            return geometry_msgs.msg.PoseStamped(header=header, pose=pose)
        sent = geometry_msgs.msg.PoseWithCovarianceStamped(header=header)
        covariance = np.zeros((6, 6))
        covariance[0, 0] = covariance[1, 1] = _SPREAD_M**2
        covariance[5, 5] = _SPREAD_RAD**2
        sent.pose.pose, sent.pose.covariance = pose, covariance.ravel().tolist()
        return sent

    def _clear(self, tool: str) -> None:
        for mark in self._marks.pop(tool, ()):
            mark.remove()


def _yaw(start: Floats, end: Floats) -> float:
    along = end - start
    return math.atan2(along[1], along[0])


def _said(topic: str, tool: str, at: Floats, yaw: float) -> str:
    turn = "" if tool == POINT else f", {math.degrees(yaw):.0f}°"
    return f"Sent to {topic}: {at[0]:.2f}, {at[1]:.2f} m{turn}"
