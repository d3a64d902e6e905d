"""Messages about goals, which programs import from all modules of actionlib."""

from __future__ import annotations

from typing import Any

from gazelle.ros.actions.states import name_of
from gazelle.ros.messages import load_message


def get_name_of_constant(C: Any, n: int) -> str:  # noqa: N803  # actionlib's name
    """Return the name of a state in a class of states."""
    return name_of(C, n)


GoalID: Any = load_message("actionlib_msgs/GoalID")
GoalStatus: Any = load_message("actionlib_msgs/GoalStatus")
# actionlib gives the class of messages this method, and programs use it.
GoalStatus.to_string = classmethod(get_name_of_constant)
GoalStatusArray: Any = load_message("actionlib_msgs/GoalStatusArray")
