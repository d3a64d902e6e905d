"""The nodelet ``turtlebot_follower``: follow the object in front of the camera (http://wiki.ros.org/turtlebot_follower)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from gazelle_ros.base.array_types import Floats
from gazelle_ros.base.tuned_fields import tunable
from gazelle_ros.builtin.arguments import CallbackWork
from gazelle_ros.builtin.images.depth.metric import depths_of
from gazelle_ros.builtin.parameters import settings_of
from gazelle_ros.builtin.speeds import Speeds, twist_of
from gazelle_ros.builtin.tuned_settings import TunedSettings
from gazelle_ros.msgs import geometry_msgs, sensor_msgs, turtlebot_msgs, visualization_msgs
from gazelle_ros.node import Node

_LEAST_POINTS = 4000
_ACROSS_RAD, _DOWN_RAD = 60.0 / 57.0, 45.0 / 57.0
"""Angles of view; both are divided by the columns of an image, as in the original."""
_FRAME = "/camera_rgb_optical_frame"
_FAR_M = 1e6
_STOP: Speeds = (0.0, 0.0)


@dataclass(frozen=True, slots=True)
class FollowerSettings:
    """Parameters of ``turtlebot_follower``, with the defaults of its dynamic_reconfigure server.

    Attributes:
        min_x: Left side of the box with the points that count [m].
        max_x: Its right side [m].
        min_y: Its lower side, above the camera's axis [m].
        max_y: Its upper side [m].
        max_z: Its depth [m].
        goal_z: Distance to keep [m].
        x_scale: Rate of turning for each metre beside the axis [rad/s/m].
        z_scale: Speed for each metre of distance too much [1/s].
        enabled: Whether it commands the robot at first.
    """

    min_x: float = tunable(-0.2, -3.0, 3.0)
    max_x: float = tunable(0.2, -3.0, 3.0)
    min_y: float = tunable(0.1, -1.0, 3.0)
    max_y: float = tunable(0.5, -1.0, 3.0)
    max_z: float = tunable(0.8, 0.0, 3.0)
    goal_z: float = tunable(0.6, 0.0, 3.0)
    x_scale: float = tunable(1.0, 0.0, 3.0)
    z_scale: float = tunable(5.0, 0.0, 10.0)
    enabled: bool = True

    def target(self, depths: Floats) -> tuple[float, float, float] | None:
        """Return the middle of the points in the box, and their least depth [m].

        Args:
            depths: Of an image [m], NaN where there is none, shape (height, width).

        Returns:
            x to the right, y upwards, and z; None if there are too few points.
        """
        rows, columns = depths.shape
        right = np.sin((np.arange(columns) - columns / 2.0) * (_ACROSS_RAD / columns))
        up = np.sin((rows / 2.0 - np.arange(rows)) * (_DOWN_RAD / columns))
        near = np.where(depths <= self.max_z, depths, np.nan)
        x, y = near * right, near * up[:, None]
        inside = (x > self.min_x) & (x < self.max_x) & (y > self.min_y) & (y < self.max_y)
        if int(inside.sum()) <= _LEAST_POINTS:
            return None
        return float(x[inside].mean()), float(y[inside].mean()), float(near[inside].min())

    def command(self, target: tuple[float, float, float] | None) -> Speeds:
        """Return the speeds towards a target."""
        if target is None:
            return _STOP
        x, _, z = target
        return (z - self.goal_z) * self.z_scale, -x * self.x_scale


class Follower(CallbackWork):
    """Commands on ``~cmd_vel`` by the depth images of ``depth/image_rect``; ``~change_state`` stops them.

    ``~marker`` shows the target, ``~bbox`` the box.

    Args:
        node: On the graph.

    Raises:
        Error: A parameter is of another kind.
    """

    def __init__(self, node: Node) -> None:
        super().__init__(node)
        settings = settings_of(node, FollowerSettings)
        self.following = settings.enabled
        self._tuned = TunedSettings(node, settings, lambda _settings: None)
        marker = visualization_msgs.msg.Marker
        self._output = node.advertise("~cmd_vel", geometry_msgs.msg.Twist, queue_size=1)
        self._target = node.advertise("~marker", marker, queue_size=1)
        self._box = node.advertise("~bbox", marker, queue_size=1)
        node.serve("~change_state", turtlebot_msgs.srv.SetFollowState, self._switch)
        node.subscribe("depth/image_rect", sensor_msgs.msg.Image, self._take, 1)

    def _take(self, image: sensor_msgs.msg.Image) -> None:
        settings = self._tuned.settings
        target = settings.target(depths_of(image))
        self._target.publish(
            _marker(0, target or (0.0, 0.0, _FAR_M), (0.2, 0.2, 0.2), (1.0, 0.0, 1.0))
        )
        if self.following:
            self._output.publish(twist_of(settings.command(target)))
        middle = (
            0.5 * (settings.min_x + settings.max_x),
            -0.5 * (settings.min_y + settings.max_y),
            0.5 * settings.max_z,
        )
        size = (settings.max_x - settings.min_x, settings.max_y - settings.min_y, settings.max_z)
        self._box.publish(_marker(1, middle, size, (0.0, 1.0, 0.5)))

    def _switch(self, request: turtlebot_msgs.srv.SetFollowStateRequest) -> list[Any]:
        """Stop following, with a command of zeros, or begin again."""
        if self.following and request.state == request.STOPPED:
            self._output.publish(twist_of(_STOP))
            self.following = False
        elif request.state == request.FOLLOW:
            self.following = True
        return [turtlebot_msgs.srv.SetFollowStateResponse.OK]


def _marker(
    number: int,
    place: tuple[float, float, float],
    size: tuple[float, float, float],
    look: tuple[float, float, float],
) -> visualization_msgs.msg.Marker:
    """Return a sphere (0) or a box (1); its look is red, green and how dense it is."""
    kind = visualization_msgs.msg.Marker
    made = kind(ns="my_namespace", id=number, type=kind.CUBE if number else kind.SPHERE)
    made.header.frame_id, made.pose.orientation.w = _FRAME, 1.0
    at, scale = made.pose.position, made.scale
    at.x, at.y, at.z = place
    scale.x, scale.y, scale.z = size
    made.color.r, made.color.g, made.color.a = look
    return made
