"""Actions: goals that take time, report feedback, and can be cancelled.

The protocol is that of http://wiki.ros.org/actionlib.
"""

from gazelle.ros.actions.client import ActionClient, ClientGoalHandle
from gazelle.ros.actions.server import ActionServer, ServerGoalHandle
from gazelle.ros.actions.simple_client import SimpleActionClient
from gazelle.ros.actions.simple_server import SimpleActionServer
from gazelle.ros.actions.spec import ActionException
from gazelle.ros.actions.states import CommState, GoalStatus, SimpleGoalState, TerminalState

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
