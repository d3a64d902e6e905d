"""The node ``slam_gmapping``: a map while driving (http://wiki.ros.org/gmapping)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import fields

from gazelle.array_types import Floats
from gazelle.bridges.navigation.mapping_node import MappingNode
from gazelle.description.occupancy import OccupancyMap
from gazelle.navigation.following import Pose2
from gazelle.navigation.mapping import GmappingSettings, GridSlam
from gazelle_ros.base.parameter_values import value_of
from gazelle_ros.builtin.arguments import run_node
from gazelle_ros.builtin.parameters import private_values
from gazelle_ros.clock import SECOND
from gazelle_ros.msgs import sensor_msgs, std_msgs
from gazelle_ros.node import Node

_OTHERS = ("seed", "transform_publish_period", "map_update_interval", "tf_delay")
_UNUSED = ("llsamplerange", "llsamplestep", "lasamplerange", "lasamplestep", "inverted_laser")
"""Parameters of the original that change nothing here."""


def main(arguments: Sequence[str]) -> int:
    """Run the mapping until shutdown; returns the exit code."""
    return run_node(arguments, "slam_gmapping", GmappingNode)


class GmappingNode(MappingNode):
    """A `GridSlam` on a graph.

    Args:
        node: On the graph; parameters are those of ``slam_gmapping``.

    Raises:
        Error: A parameter is wrong.
    """

    def __init__(self, node: Node) -> None:
        values = private_values(node)
        self.slam = GridSlam(GmappingSettings.read(values), int(value_of(values, "seed", 0)))
        period = value_of(values, "transform_publish_period", 0.05)
        interval = value_of(values, "map_update_interval", 5.0)
        ahead = value_of(values, "tf_delay", period)
        known = [*(each.name for each in fields(GmappingSettings)), *_OTHERS, *_UNUSED]
        super().__init__(node, "base_link", "scan", interval, period, ahead, known)
        self._entropies = node.advertise("~entropy", std_msgs.msg.Float64, latch=True)

    def place(self) -> Pose2 | None:
        """Return the pose of the odometry frame on the map."""
        return self.slam.map_to_odom

    def drawn(self) -> OccupancyMap:
        """Return the best particle's map."""
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
        stamp = message.header.stamp.to_nsec()
        if odom is None:
            return False
        # What is too near is as good as nothing.
        most = max(0.0, message.range_max)  # of NaN 0
        ranges[ranges < message.range_min] = most
        changed = self.slam.update(stamp / SECOND, odom, ranges, angles, most, laser)
        if changed:
            entropy = std_msgs.msg.Float64()
            entropy.data = self.slam.entropy()
            self._entropies.publish(entropy)
        return changed
