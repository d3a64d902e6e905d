"""The module that ``moveit_commander.robot`` stands on."""

from gazelle.bridges.moveit.client.robot_interface import RobotInterface

__all__ = ["RobotInterface"]
