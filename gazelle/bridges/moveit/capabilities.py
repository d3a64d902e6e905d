"""Capabilities of ``move_group``: services and actions, selected by parameters."""

from __future__ import annotations

import warnings
from typing import Any

from gazelle.errors import PlanningWarning, did_you_mean
from gazelle_ros.node import Node

CAPABILITIES = {
    "ApplyPlanningSceneService": ("apply_planning_scene",),
    "ClearOctomapService": ("clear_octomap",),
    "MoveGroupCartesianPathService": ("compute_cartesian_path",),
    "MoveGroupExecuteTrajectoryAction": ("execute_trajectory",),
    "MoveGroupGetPlanningSceneService": ("get_planning_scene",),
    "MoveGroupKinematicsService": ("compute_ik", "compute_fk"),
    "MoveGroupMoveAction": ("move_group",),
    "MoveGroupPickPlaceAction": ("pickup", "place"),
    "MoveGroupPlanService": ("plan_kinematic_path",),
    "MoveGroupQueryPlannersService": (
        "query_planner_interface",
        "get_planner_params",
        "set_planner_params",
    ),
    "MoveGroupStateValidationService": ("check_state_validity",),
}
"""Names of services and actions by capability, which MoveIt has with ``move_group/`` before them."""
_PREFIX = "move_group/"


class Capabilities:
    """Capabilities that ``~disable_capabilities`` leaves enabled; all of them by default.

    What ``~capabilities`` adds beyond those that are known is warned of.

    Args:
        node: Node of the parameters: names with blanks between.
    """

    def __init__(self, node: Node) -> None:
        disabled = _listed(node.get_param("~disable_capabilities", ""))
        for name in (*_listed(node.get_param("~capabilities", "")), *disabled):
            if name not in CAPABILITIES:
                text = f"move_group has no capability '{name}'; {did_you_mean(name, CAPABILITIES)}"
                warnings.warn(PlanningWarning(text), stacklevel=2)
        self._off = {each for name in disabled for each in CAPABILITIES.get(name, ())}

    def __contains__(self, name: str) -> bool:
        """Return whether a service or action is offered."""
        return name not in self._off


def _listed(given: Any) -> list[str]:
    return [word.removeprefix(_PREFIX) for word in str(given or "").split()]
