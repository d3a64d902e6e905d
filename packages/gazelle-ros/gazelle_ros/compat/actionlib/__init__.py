"""actionlib's interface on Gazelle's actions."""

from gazelle_ros.actions import (
    ActionException,
    ClientGoalHandle,
    CommState,
    ServerGoalHandle,
    SimpleGoalState,
    TerminalState,
)
from gazelle_ros.compat.actionlib.action_client import ActionClient, get_name_of_constant
from gazelle_ros.compat.actionlib.action_server import ActionServer
from gazelle_ros.compat.actionlib.goal_id_generator import GoalIDGenerator
from gazelle_ros.compat.actionlib.goal_messages import GoalID, GoalStatus, GoalStatusArray
from gazelle_ros.compat.actionlib.handle_tracker_deleter import HandleTrackerDeleter
from gazelle_ros.compat.actionlib.simple_action_client import SimpleActionClient
from gazelle_ros.compat.actionlib.simple_action_server import SimpleActionServer
from gazelle_ros.compat.actionlib.status_tracker import StatusTracker

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
