"""Actions: goals that take time, report feedback, and can be cancelled.

The protocol is that of http://wiki.ros.org/actionlib.
"""

from gazelle_ros.actions.client import ActionClient, ClientGoalHandle
from gazelle_ros.actions.server import ActionServer, ServerGoalHandle
from gazelle_ros.actions.simple_client import SimpleActionClient
from gazelle_ros.actions.simple_server import SimpleActionServer
from gazelle_ros.actions.spec import ActionException
from gazelle_ros.actions.states import CommState, GoalStatus, SimpleGoalState, TerminalState

__all__ = [
    "ActionClient",
    "ActionException",
    "ActionServer",
    "ClientGoalHandle",
    "CommState",
    "GoalStatus",
    "ServerGoalHandle",
    "SimpleActionClient",
    "SimpleActionServer",
    "SimpleGoalState",
    "TerminalState",
]
