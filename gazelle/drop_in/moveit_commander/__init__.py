"""MoveIt's Python interface: what scripts import as ``moveit_commander``."""

from gazelle.drop_in.moveit_commander.exception import MoveItCommanderException
from gazelle.drop_in.moveit_commander.interpreter import (
    MoveGroupCommandInterpreter,
    MoveGroupInfoLevel,
)
from gazelle.drop_in.moveit_commander.move_group import MoveGroupCommander
from gazelle.drop_in.moveit_commander.planning_scene_interface import (
    PlanningSceneInterface,
)
from gazelle.drop_in.moveit_commander.robot import RobotCommander
from gazelle.drop_in.moveit_commander.roscpp_initializer import (
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
