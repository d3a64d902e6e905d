"""MoveIt's Python interface: what scripts import as ``moveit_commander``."""

from gazelle.bridges.moveit.modules.moveit_commander.exception import MoveItCommanderException
from gazelle.bridges.moveit.modules.moveit_commander.interpreter import (
    MoveGroupCommandInterpreter,
    MoveGroupInfoLevel,
)
from gazelle.bridges.moveit.modules.moveit_commander.move_group import MoveGroupCommander
from gazelle.bridges.moveit.modules.moveit_commander.planning_scene_interface import (
    PlanningSceneInterface,
)
from gazelle.bridges.moveit.modules.moveit_commander.robot import RobotCommander
from gazelle.bridges.moveit.modules.moveit_commander.roscpp_initializer import (
    roscpp_initialize,
    roscpp_shutdown,
)

__all__ = [
    "MoveGroupCommandInterpreter",
    "MoveGroupCommander",
    "MoveGroupInfoLevel",
    "MoveItCommanderException",
    "PlanningSceneInterface",
    "RobotCommander",
    "roscpp_initialize",
    "roscpp_shutdown",
]
