"""The nodelet ``kobuki_bumper2pc``: bumps and cliffs as a cloud of points (http://wiki.ros.org/kobuki_bumper2pc)."""

from __future__ import annotations

import math
from dataclasses import dataclass

from gazelle_ros.builtin.arguments import CallbackWork
from gazelle_ros.builtin.parameters import settings_of
from gazelle_ros.compat.sensor_msgs.point_cloud2 import create_cloud_xyz32
from gazelle_ros.msgs import kobuki_msgs, sensor_msgs, std_msgs
from gazelle_ros.node import Node

_STATE = kobuki_msgs.msg.SensorState
_SIDE_RAD = 0.34906585
_AWAY_M = 100.0
_LEFT, _CENTRE, _RIGHT = (
    (_STATE.BUMPER_LEFT, _STATE.CLIFF_LEFT),
    (_STATE.BUMPER_CENTRE, _STATE.CLIFF_CENTRE),
    (_STATE.BUMPER_RIGHT, _STATE.CLIFF_RIGHT),
)
"""Bits of the bumper and the cliff sensor of each direction."""


@dataclass(frozen=True, slots=True)
class BumperCloudSettings:
    """Parameters of ``kobuki_bumper2pc``.

    Attributes:
        pointcloud_radius: Distance of the points from the axis of the base [m].
        pointcloud_height: Their z [m].
        side_point_angle: Of the points at the sides, from the axis y towards the front [rad].
        base_link_frame: Frame of the cloud.
    """

    pointcloud_radius: float = 0.25
    pointcloud_height: float = 0.04
    side_point_angle: float = _SIDE_RAD
    base_link_frame: str = "/base_link"

    def points(self, state: kobuki_msgs.msg.SensorState) -> list[tuple[float, float, float]]:
        """Return a point to the left, ahead and to the right [m]; those of silent sensors are far off."""
        z, radius = self.pointcloud_height, self.pointcloud_radius
        far = _AWAY_M * math.sin(_SIDE_RAD), _AWAY_M * math.cos(_SIDE_RAD)
        x, y = radius * math.sin(self.side_point_angle), radius * math.cos(self.side_point_angle)
        side = {True: (x, y), False: far}
        left, right = side[_touches(state, *_LEFT)], side[_touches(state, *_RIGHT)]
        ahead = radius if _touches(state, *_CENTRE) else far[0]
        return [(left[0], left[1], z), (ahead, 0.0, z), (right[0], -right[1], z)]


class BumperCloud(CallbackWork):
    """Clouds on ``~pointcloud`` while ``~core_sensors`` report a bump or cliff, and one after it.

    Args:
        node: On the graph.

    Raises:
        Error: A parameter is of another kind.
    """

    def __init__(self, node: Node) -> None:
        super().__init__(node)
        self.settings = settings_of(node, BumperCloudSettings)
        self._touched = False
        self._output = node.advertise("~pointcloud", sensor_msgs.msg.PointCloud2, queue_size=10)
        node.subscribe("~core_sensors", _STATE, self._take, 10)

    def _take(self, state: kobuki_msgs.msg.SensorState) -> None:
        touches = bool(state.bumper or state.cliff)
        if not self._output.has_subscribers or not (touches or self._touched):
            return
        self._touched = touches
        header = std_msgs.msg.Header(
            stamp=state.header.stamp, frame_id=self.settings.base_link_frame
        )
        cloud = create_cloud_xyz32(header, self.settings.points(state))
        cloud.is_dense = True
        self._output.publish(cloud)


def _touches(state: kobuki_msgs.msg.SensorState, bumper: int, cliff: int) -> bool:
    return bool(state.bumper & bumper or state.cliff & cliff)
