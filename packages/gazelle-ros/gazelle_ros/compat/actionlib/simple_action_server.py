"""A server that works on one goal at a time, in the node of this process."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from gazelle_ros import actions
from gazelle_ros.compat.actionlib.action_server import ActionServer, ServerGoalHandle
from gazelle_ros.compat.actionlib.goal_messages import GoalStatus
from gazelle_ros.compat.rospy.state import process

__all__ = ["ActionServer", "GoalStatus", "ServerGoalHandle", "SimpleActionServer"]


class SimpleActionServer(actions.SimpleActionServer):
    """Works on one goal at a time; see `gazelle_ros.actions.SimpleActionServer`.

    Args:
        name: Of the action.
        ActionSpec: The message class of the action.
        execute_cb: Called with each goal, on a thread of its own.
        auto_start: Start at once.
    """

    def __init__(
        self,
        name: str,
        ActionSpec: Any,  # noqa: N803  # actionlib's name
        execute_cb: Callable[[Any], Any] | None = None,
        auto_start: bool = True,  # noqa: FBT001, FBT002  # actionlib's interface
    ) -> None:
        super().__init__(process.require(), name, ActionSpec, execute_cb, auto_start=auto_start)
