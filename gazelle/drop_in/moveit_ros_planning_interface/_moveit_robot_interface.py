"""The module that ``moveit_commander.robot`` stands on in MoveIt."""

from __future__ import annotations

from typing import Any, ClassVar

from gazelle.drop_in.moveit_client.byte_interface import ByteInterface
from gazelle.drop_in.moveit_commander.robot import RobotCommander

__all__ = ["RobotInterface"]


class RobotInterface(ByteInterface):
    """Names, limits and states of a robot."""

    client: ClassVar[type[Any]] = RobotCommander
    takes: ClassVar = {"get_robot_markers": ("moveit_msgs/RobotState",)}
