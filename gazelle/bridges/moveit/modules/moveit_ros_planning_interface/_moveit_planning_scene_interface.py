"""The module that ``moveit_commander.planning_scene_interface`` stands on."""

from gazelle.bridges.moveit.client.scene_client import (
    PlanningSceneClient as PlanningSceneInterface,
)

__all__ = ["PlanningSceneInterface"]
