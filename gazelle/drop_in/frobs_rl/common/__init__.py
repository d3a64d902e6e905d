"""Helpers that steer the simulator, controllers, nodes, parameters and descriptions."""

from __future__ import annotations

from gazelle.drop_in.frobs_rl.common import (
    ros_controllers,
    ros_gazebo,
    ros_launch,
    ros_node,
    ros_params,
    ros_spawn,
    ros_urdf,
)

__all__ = [
    "ros_controllers",
    "ros_gazebo",
    "ros_launch",
    "ros_node",
    "ros_params",
    "ros_spawn",
    "ros_urdf",
]
