"""The state machine of ROS's ``move_base``: plan, control and recover until the goal is reached."""

from __future__ import annotations

from gazelle.navigation.move_base.assembly import NavigationStack, navigation_stack
from gazelle.navigation.move_base.recovery import RecoveryBehavior, register_recovery
from gazelle.navigation.move_base.settings import MoveBaseSettings
from gazelle.navigation.move_base.state_machine import GoalOutcome, MoveBase, RobotState

__all__ = [
    "GoalOutcome",
    "MoveBase",
    "MoveBaseSettings",
    "NavigationStack",
    "RecoveryBehavior",
    "RobotState",
    "navigation_stack",
    "register_recovery",
]
