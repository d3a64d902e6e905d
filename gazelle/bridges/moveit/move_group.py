"""The node ``move_group`` (http://moveit.ros.org/documentation/concepts)."""

from __future__ import annotations

from collections.abc import Sequence

from gazelle.bridges.moveit.kinematics_services import KinematicsServices
from gazelle.bridges.moveit.motion_actions import (
    ExecuteTrajectoryAction,
    MoveGroupAction,
)
from gazelle.bridges.moveit.pick_place_actions import PickupAction, PlaceAction
from gazelle.bridges.moveit.planning_context import PlanningContext
from gazelle.bridges.moveit.planning_services import PlanningServices
from gazelle.bridges.moveit.scene_services import SceneServices
from gazelle.bridges.moveit.trajectory_execution import TrajectoryExecutor
from gazelle_ros.builtin.arguments import parse_arguments, spin
from gazelle_ros.node import Node


def main(arguments: Sequence[str]) -> int:
    """Run the node until shutdown; returns the exit code."""
    found = parse_arguments(arguments, "move_group")
    with found.start() as node:
        MoveGroupNode(node)
        return spin(node)


class MoveGroupNode:
    """MoveIt's services and actions for the robot of ``robot_description`` and its SRDF.

    Args:
        node: On the graph; parameters are those of ``move_group``.

    Raises:
        Error: There is no description of a robot, or it cannot be read.
    """

    def __init__(self, node: Node) -> None:
        self.context = PlanningContext(node)
        self.kinematics = KinematicsServices(self.context)
        self.planning = PlanningServices(self.context)
        self.scene = SceneServices(self.context)
        self.executor = TrajectoryExecutor(self.context)
        shared = (self.context, self.planning, self.scene, self.executor)
        offered = self.context.capabilities
        if "move_group" in offered:
            self.moving = MoveGroupAction(*shared)
        if "execute_trajectory" in offered:
            self.following = ExecuteTrajectoryAction(self.context, self.executor)
        if "pickup" in offered:
            self.picking, self.placing = PickupAction(*shared), PlaceAction(*shared)
