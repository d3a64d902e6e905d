"""The node ``slam_karto``: a map of scans with optimised poses (http://wiki.ros.org/slam_karto)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import fields

import numpy as np

from gazelle.array_types import Floats
from gazelle.bridges.navigation.mapping_node import MappingNode
from gazelle.description.occupancy import OccupancyMap
from gazelle.navigation.following import Pose2
from gazelle.navigation.mapping.karto import KartoSettings, KartoSlam
from gazelle_ros.base.parameter_values import value_of
from gazelle_ros.builtin.arguments import run_node
from gazelle_ros.builtin.parameters import private_values
from gazelle_ros.msgs import sensor_msgs
from gazelle_ros.node import Node

_OTHERS = ("transform_publish_period", "map_update_interval", "transform_tolerance", "delta")
_UNUSED = (
    "use_scan_barycenter", "minimum_time_interval", "link_match_minimum_response_fine",
    "link_scan_maximum_distance", "loop_match_maximum_variance_coarse",
    "loop_match_minimum_response_coarse", "correlation_search_space_dimension",
    "correlation_search_space_resolution", "correlation_search_space_smear_deviation",
    "loop_search_space_dimension", "loop_search_space_resolution",
    "loop_search_space_smear_deviation", "distance_variance_penalty", "angle_variance_penalty",
    "fine_search_angle_offset", "coarse_search_angle_offset", "coarse_angle_resolution",
    "minimum_angle_penalty", "minimum_distance_penalty", "use_response_expansion",
)  # fmt: skip
"""Parameters of the original that change nothing here."""


def main(arguments: Sequence[str]) -> int:
    """Run the mapping until shutdown; returns the exit code."""
    return run_node(arguments, "slam_karto", KartoNode)


class KartoNode(MappingNode):
    """A `KartoSlam` on a graph.

    Args:
        node: On the graph; parameters are those of ``slam_karto``.

    Raises:
        Error: A parameter is wrong.
    """

    def __init__(self, node: Node) -> None:
        values = private_values(node)
        self.slam = KartoSlam(KartoSettings.read(values))
        period = value_of(values, "transform_publish_period", 0.05)
        interval = value_of(values, "map_update_interval", 5.0)
        ahead = value_of(values, "transform_tolerance", 0.0)
        known = [*(each.name for each in fields(KartoSettings)), *_OTHERS, *_UNUSED]
        super().__init__(node, "base_link", "scan", interval, period, ahead, known)

    def place(self) -> Pose2 | None:
        """Return the pose of the odometry frame on the map."""
        return self.slam.map_to_odom

    def drawn(self) -> OccupancyMap:
        """Return the map of all scans."""
        return self.slam.map()

    def process_scan(
        self,
        message: sensor_msgs.msg.LaserScan,
        ranges: Floats,
        angles: Floats,
        laser: Pose2,
        odom: Pose2 | None,
    ) -> bool:
        """Process a scan; returns whether the map has changed."""
        if odom is None:
            return False
        ranges[ranges < message.range_min] = np.inf
        most = max(0.0, message.range_max)  # of NaN 0
        return self.slam.update(odom, ranges, angles, most, laser)
