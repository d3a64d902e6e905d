"""State machines of tasks with the interface of executive_smach (ROS 1 Noetic)."""

from __future__ import annotations

from gazelle_ros.drop_in.smach.concurrence import Concurrence
from gazelle_ros.drop_in.smach.container import Container
from gazelle_ros.drop_in.smach.exceptions import (
    InvalidConstructionError,
    InvalidStateError,
    InvalidTransitionError,
    InvalidUserCodeError,
    SmachError,
)
from gazelle_ros.drop_in.smach.iterator import Iterator
from gazelle_ros.drop_in.smach.log import (
    is_shutdown,
    logdebug,
    logerr,
    loginfo,
    logwarn,
    set_loggers,
    set_shutdown_check,
)
from gazelle_ros.drop_in.smach.state import (
    CBInterface,
    CBState,
    State,
    cb_interface,
    has_smach_interface,
)
from gazelle_ros.drop_in.smach.state_machine import Sequence, StateMachine
from gazelle_ros.drop_in.smach.user_data import Remapper, UserData

_HERE = "gazelle_ros.drop_in.smach"
PLACES = {"sequence": f"{_HERE}.state_machine", "util": f"{_HERE}.state"}
"""From a module's name in smach to the one that has what it had."""

__all__ = [
    "CBInterface",
    "CBState",
    "Concurrence",
    "Container",
    "InvalidConstructionError",
    "InvalidStateError",
    "InvalidTransitionError",
    "InvalidUserCodeError",
    "Iterator",
    "Remapper",
    "Sequence",
    "SmachError",
    "State",
    "StateMachine",
    "UserData",
    "cb_interface",
    "has_smach_interface",
    "is_shutdown",
    "logdebug",
    "logerr",
    "loginfo",
    "logwarn",
    "set_loggers",
    "set_shutdown_check",
]
