"""Planners: paths over a costmap, and velocities that follow them.

Names of types, parameters and rules are those of ROS's ``move_base``.
"""

from __future__ import annotations

from pathlib import Path

from gazelle.native import search_path

__path__ = search_path([str(Path(__file__).parent)])

from gazelle.navigation.planners.dwa import DwaPlanner
from gazelle.navigation.planners.global_planner import GlobalPlanner
from gazelle.navigation.planners.navfn import NavfnPlanner
from gazelle.navigation.planners.plugins import (
    GlobalPlannerPlugin,
    LocalPlannerPlugin,
    register_global,
    register_local,
)

__all__ = [
    "DwaPlanner",
    "GlobalPlanner",
    "GlobalPlannerPlugin",
    "LocalPlannerPlugin",
    "NavfnPlanner",
    "register_global",
    "register_local",
]
