"""A client that follows one goal, in the node of this process."""

from __future__ import annotations

from typing import Any

from gazelle_ros import actions
from gazelle_ros.actions.states import SimpleGoalState
from gazelle_ros.compat.actionlib.action_client import (
    ActionClient,
    CommState,
    get_name_of_constant,
)
from gazelle_ros.compat.actionlib.goal_messages import GoalStatus
from gazelle_ros.compat.rospy.state import process

__all__ = [
    "ActionClient",
    "CommState",
    "GoalStatus",
    "SimpleActionClient",
    "SimpleGoalState",
    "get_name_of_constant",
]


class SimpleActionClient(actions.SimpleActionClient):
    """Follows one goal; see `gazelle_ros.actions.SimpleActionClient`.

    Args:
        ns: Name of the action.
        ActionSpec: The message class of the action.
    """

    def __init__(self, ns: str, ActionSpec: Any) -> None:  # noqa: N803  # actionlib's name
        super().__init__(process.require(), ns, ActionSpec)
