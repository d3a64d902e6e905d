"""Parameters of ``robot.navigation`` where none are given: for robots of a TurtleBot3's size."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from gazelle.array_types import Floats
from gazelle.errors import SimulationError

_SCAN = {"scan": {"data_type": "LaserScan", "marking": True, "clearing": True}}
_COSTMAP = {
    "inflation_layer": {"inflation_radius": 1.0, "cost_scaling_factor": 3.0},
    "obstacle_layer": {"observation_sources": "scan", "raytrace_range": 3.5, **_SCAN},
    "update_frequency": 5.0,
}
_OBSTACLES = {"name": "obstacle_layer", "type": "costmap_2d::ObstacleLayer"}
_INFLATION = {"name": "inflation_layer", "type": "costmap_2d::InflationLayer"}
_STATIC = {"name": "static_layer", "type": "costmap_2d::StaticLayer"}
USUAL: Mapping[str, Any] = {
    "base_local_planner": "dwa_local_planner/DWAPlannerROS",
    "controller_frequency": 10.0,
    "planner_frequency": 1.0,
    "oscillation_timeout": 10.0,
    "oscillation_distance": 0.2,
    "global_costmap": {**_COSTMAP, "plugins": [_STATIC, _OBSTACLES, _INFLATION]},
    "local_costmap": {
        **_COSTMAP,
        "plugins": [_OBSTACLES, _INFLATION],
        "rolling_window": True,
        "width": 3.0,
        "height": 3.0,
        "update_frequency": 10.0,
    },
    "DWAPlannerROS": {
        "max_vel_x": 0.22, "min_vel_x": -0.1, "max_vel_y": 0.0, "min_vel_y": 0.0,
        "max_vel_trans": 0.22, "min_vel_trans": 0.1, "max_vel_theta": 2.0, "min_vel_theta": 0.8,
        "acc_lim_y": 0.0, "xy_goal_tolerance": 0.1, "yaw_goal_tolerance": 0.15, "sim_time": 1.5,
        "vx_samples": 12, "vy_samples": 0, "vth_samples": 30, "path_distance_bias": 32.0,
        "goal_distance_bias": 20.0, "occdist_scale": 0.02, "forward_point_distance": 0.1,
    },
}  # fmt: skip


def merged(usual: Mapping[str, Any], overrides: Mapping[str, Any]) -> dict[str, Any]:
    """Merge parameters over others, level by level.

    Raises:
        SimulationError: They are not a mapping.
    """
    if not isinstance(overrides, Mapping):
        raise SimulationError(f"parameters must be a mapping of names to values, not {overrides!r}")
    found = dict(usual)
    for name, value in overrides.items():
        below = found.get(name)
        if isinstance(value, Mapping) and isinstance(below, Mapping):
            found[name] = merged(below, value)
        else:
            found[name] = value
    return found


def with_outline(values: Mapping[str, Any], outline: Floats | None) -> dict[str, Any]:
    """Return both costmaps with the robot's outline, where they have none."""
    found = {}
    for name in ("global_costmap", "local_costmap"):
        own = dict(values[name])
        if outline is not None and "footprint" not in own and "robot_radius" not in own:
            own["footprint"] = outline.tolist()
        found[name] = own
    return found
