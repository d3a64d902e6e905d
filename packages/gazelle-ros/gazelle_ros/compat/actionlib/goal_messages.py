"""Messages about goals, which programs import from all modules of actionlib."""

from __future__ import annotations

from typing import Any

from gazelle_ros.actions.states import name_of
from gazelle_ros.msgs import actionlib_msgs


def get_name_of_constant(C: Any, n: int) -> str:  # noqa: N803  # actionlib's name
    """Return the name of a state in a class of states."""
    return name_of(C, n)


GoalID = actionlib_msgs.msg.GoalID
GoalStatus = actionlib_msgs.msg.GoalStatus
# actionlib gives the class of messages this method, and programs use it.
GoalStatus.to_string = classmethod(get_name_of_constant)  # type: ignore[attr-defined]
GoalStatusArray = actionlib_msgs.msg.GoalStatusArray
