"""The module that ``moveit_commander.move_group`` stands on."""

from gazelle.bridges.moveit.client.move_group_interface import MoveGroupInterface

__all__ = ["MoveGroupInterface"]
