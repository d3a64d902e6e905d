"""The module that ``moveit_commander.planning_scene_interface`` stands on in MoveIt."""

from __future__ import annotations

from typing import Any, ClassVar

from gazelle.drop_in.moveit_client.byte_interface import ByteInterface
from gazelle.drop_in.moveit_commander import planning_scene_interface

__all__ = ["PlanningSceneInterface"]


class PlanningSceneClient(ByteInterface):
    """The planning scene of ``move_group``."""

    client: ClassVar[type[Any]] = planning_scene_interface.PlanningSceneInterface
    takes: ClassVar = {"apply_planning_scene": ("moveit_msgs/PlanningScene",)}


PlanningSceneInterface = PlanningSceneClient
