"""The node ``marker_server`` of ``interactive_marker_twist_server``: a robot that is pulled by a marker."""

from __future__ import annotations

import math
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from gazelle_ros.base.errors import RosError
from gazelle_ros.base.parameter_values import Values, value_of, warn_of_unknown
from gazelle_ros.compat import rospy
from gazelle_ros.drop_in.interactive_markers.interactive_marker_server import (
    InteractiveMarkerServer,
)
from gazelle_ros.msgs import geometry_msgs, visualization_msgs

_CONTROL = visualization_msgs.msg.InteractiveMarkerControl
_AXES = ("x", "y", "z")
_TURNS = {"x": (1.0, 0.0, 0.0), "y": (0.0, 0.0, 1.0), "z": (0.0, 1.0, 0.0)}
"""Orientation (x, y, z) beside a w of 1 that puts the axis x of a control along an axis of the robot."""
_BY_AXIS = {
    "linear_scale": 1.0,
    "max_positive_linear_velocity": 1.0,
    "max_negative_linear_velocity": -1.0,
}
_PLAIN = {
    "link_name": "base_link",
    "robot_name": "robot",
    "angular_scale": 2.2,
    "max_angular_velocity": 2.2,
    "marker_size_scale": 1.0,
}


@dataclass(frozen=True, slots=True)
class TwistMarkerSettings:
    """Parameters of ``interactive_marker_twist_server``.

    Attributes:
        link_name: Frame that the marker hangs on.
        robot_name: Of the robot; the marker is called after it.
        angular_scale: Turning rate for an angle of the marker [1/s].
        max_angular_velocity: Greatest turning rate [rad/s].
        marker_size_scale: Size of the marker [m].
        linear_scale: Velocity for a distance of the marker, by the axes that it can be pulled along [1/s].
        max_positive_linear_velocity: Greatest velocity, by axis [m/s].
        max_negative_linear_velocity: Least velocity, by axis [m/s].
    """

    link_name: str
    robot_name: str
    angular_scale: float
    max_angular_velocity: float
    marker_size_scale: float
    linear_scale: Mapping[str, float]
    max_positive_linear_velocity: Mapping[str, float]
    max_negative_linear_velocity: Mapping[str, float]

    @classmethod
    def read(cls, where: str, values: Values) -> TwistMarkerSettings:
        """Read the parameters: scales and velocities are mappings by axis, or numbers of x alone.

        Raises:
            Error: One is of another kind, or an axis has no limits.
        """
        warn_of_unknown(where, values, [*_PLAIN, *_BY_AXIS])
        found: dict[str, Any] = {
            name: value_of(values, name, default) for name, default in _PLAIN.items()
        }
        for name, usual in _BY_AXIS.items():
            if isinstance(values.get("linear_scale"), dict):
                found[name] = _by_axis(name, values.get(name))
            else:
                found[name] = {"x": value_of(values, name, usual)}
        if len({frozenset(found[name]) for name in _BY_AXIS}) > 1:
            raise RosError(f"{', '.join(_BY_AXIS)} are of the same axes")
        return cls(**found)

    def twist(self, pose: geometry_msgs.msg.Pose) -> geometry_msgs.msg.Twist:
        """Return the velocity for a pose of the marker in the robot's frame."""
        made = geometry_msgs.msg.Twist()
        for axis, scale in self.linear_scale.items():
            speed = scale * getattr(pose.position, axis)
            most = self.max_positive_linear_velocity[axis]
            setattr(
                made.linear, axis, max(min(speed, most), self.max_negative_linear_velocity[axis])
            )
        turn = pose.orientation
        yaw = math.atan2(
            2.0 * (turn.w * turn.z + turn.x * turn.y), 1.0 - 2.0 * (turn.y**2 + turn.z**2)
        )
        limit = self.max_angular_velocity
        made.angular.z = min(max(self.angular_scale * yaw, -limit), limit)
        return made

    def marker(self) -> visualization_msgs.msg.InteractiveMarker:
        """Return the marker, with a control for each axis and one that turns."""
        made = visualization_msgs.msg.InteractiveMarker(
            name=f"{self.robot_name}_twist_marker",
            description=f"twist controller for {self.robot_name}",
            scale=self.marker_size_scale,
        )
        made.header.frame_id = self.link_name
        made.pose.orientation.w = 1.0
        moves = [axis for axis in _AXES if axis in self.linear_scale]
        made.controls = [_control(f"move_{axis}", axis, _CONTROL.MOVE_AXIS) for axis in moves]
        turning = _CONTROL.ROTATE_AXIS if "z" in moves else _CONTROL.MOVE_ROTATE
        made.controls.append(_control("rotate_z", "z", turning))
        return made


def _by_axis(name: str, values: Any) -> dict[str, float]:
    if not isinstance(values, dict) or not values or not set(values) <= set(_AXES):
        raise RosError(f"'{name}' must be a mapping of x, y or z to a number, not {values!r}")
    return {axis: value_of(values, axis, 0.0) for axis in values}


def _control(name: str, axis: str, mode: int) -> visualization_msgs.msg.InteractiveMarkerControl:
    made = _CONTROL(name=name, interaction_mode=mode, orientation_mode=_CONTROL.INHERIT)
    turn = made.orientation
    turn.w, (turn.x, turn.y, turn.z) = 1.0, _TURNS[axis]
    return made


class TwistMarkerServer:
    """The marker on ``twist_marker_server``, whose pulls become velocities on ``~cmd_vel``.

    Args:
        settings: Of the node.

    Attributes:
        markers: Server of the marker.
    """

    def __init__(self, settings: TwistMarkerSettings) -> None:
        self._settings = settings
        self._name = settings.marker().name
        self._output = rospy.Publisher("~cmd_vel", geometry_msgs.msg.Twist, queue_size=1)
        self.markers = InteractiveMarkerServer("twist_marker_server")
        self.markers.insert(settings.marker(), self._follow)
        self.markers.applyChanges()

    def _follow(self, feedback: visualization_msgs.msg.InteractiveMarkerFeedback) -> None:
        """Publish a velocity, and put the marker back to the robot."""
        self._output.publish(self._settings.twist(feedback.pose))
        self.markers.setPose(self._name, self._settings.marker().pose)
        self.markers.applyChanges()


def main(arguments: Sequence[str]) -> int:
    """Serve the marker until shutdown; returns the exit code."""
    sys.argv = ["marker_server", *arguments]
    rospy.init_node("twist_marker_server")
    name = rospy.get_name()
    TwistMarkerServer(TwistMarkerSettings.read(name, rospy.get_param(name, {})))
    rospy.spin()
    return 0
