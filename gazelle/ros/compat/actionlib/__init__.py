"""actionlib's interface on Gazelle's actions."""

from gazelle.ros.actions import (
    ActionException,
    ClientGoalHandle,
    CommState,
    ServerGoalHandle,
    SimpleGoalState,
    TerminalState,
)
from gazelle.ros.compat.actionlib.action_client import ActionClient, get_name_of_constant
from gazelle.ros.compat.actionlib.action_server import ActionServer
from gazelle.ros.compat.actionlib.goal_id_generator import GoalIDGenerator
from gazelle.ros.compat.actionlib.handle_tracker_deleter import HandleTrackerDeleter
from gazelle.ros.compat.actionlib.simple_action_client import SimpleActionClient
from gazelle.ros.compat.actionlib.simple_action_server import SimpleActionServer
from gazelle.ros.compat.actionlib.status_tracker import StatusTracker
from gazelle.ros.messages import load_message

GoalID = load_message("actionlib_msgs/GoalID")
GoalStatus = load_message("actionlib_msgs/GoalStatus")
# actionlib gives the class of messages this method, and programs use it.
GoalStatus.to_string = classmethod(get_name_of_constant)  # type: ignore[attr-defined]
GoalStatusArray = load_message("actionlib_msgs/GoalStatusArray")

__all__ = [
    "ActionClient",
    "ActionException",
    "ActionServer",
    "ClientGoalHandle",
    "CommState",
    "GoalID",
    "GoalIDGenerator",
    "GoalStatus",
    "GoalStatusArray",
    "HandleTrackerDeleter",
    "ServerGoalHandle",
    "SimpleActionClient",
    "SimpleActionServer",
    "SimpleGoalState",
    "StatusTracker",
    "TerminalState",
    "get_name_of_constant",
]
