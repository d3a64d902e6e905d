"""The client of an action, in the node of this process."""

from __future__ import annotations

from typing import Any

from gazelle_ros import actions
from gazelle_ros.actions.client import ClientGoalHandle
from gazelle_ros.actions.states import CommState, TerminalState
from gazelle_ros.compat.actionlib.goal_messages import (
    GoalID,
    GoalStatus,
    GoalStatusArray,
    get_name_of_constant,
)
from gazelle_ros.compat.rospy.state import process

__all__ = [
    "ActionClient",
    "ClientGoalHandle",
    "CommState",
    "GoalID",
    "GoalStatus",
    "GoalStatusArray",
    "TerminalState",
    "get_name_of_constant",
]


class ActionClient(actions.ActionClient):
    """Sends goals; see `gazelle_ros.actions.ActionClient`.

    Args:
        ns: Name of the action.
        ActionSpec: The message class of the action.
    """

    def __init__(self, ns: str, ActionSpec: Any) -> None:  # noqa: N803  # actionlib's name
        super().__init__(process.require(), ns, ActionSpec)
