"""The server of an action, in the node of this process."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from gazelle_ros import actions
from gazelle_ros.actions.server import ServerGoalHandle
from gazelle_ros.compat.actionlib.goal_messages import GoalID, GoalStatus, GoalStatusArray
from gazelle_ros.compat.rospy.state import process

__all__ = [
    "ActionServer",
    "GoalID",
    "GoalStatus",
    "GoalStatusArray",
    "ServerGoalHandle",
    "nop_cb",
]

_Callback = Callable[[ServerGoalHandle], Any]


def nop_cb(goal_handle: Any) -> None:
    """Do nothing."""


class ActionServer(actions.ActionServer):
    """Takes goals; see `gazelle_ros.actions.ActionServer`.

    Args:
        ns: Name of the action.
        ActionSpec: The message class of the action.
        goal_cb: Called with each new goal.
        cancel_cb: Called with each goal to be given up.
        auto_start: Start at once.
    """

    def __init__(
        self,
        ns: str,
        ActionSpec: Any,  # noqa: N803  # actionlib's name
        goal_cb: _Callback | None = None,
        cancel_cb: _Callback = nop_cb,
        auto_start: bool = True,  # noqa: FBT001, FBT002  # actionlib's interface
    ) -> None:
        super().__init__(
            process.require(), ns, ActionSpec, goal_cb, cancel_cb, auto_start=auto_start
        )
