"""State machines of tasks with the interface of executive_smach (ROS 1 Noetic)."""

from __future__ import annotations

from gazelle.compat.smach.concurrence import Concurrence
from gazelle.compat.smach.container import Container
from gazelle.compat.smach.exceptions import (
    InvalidConstructionError,
    InvalidStateError,
    InvalidTransitionError,
    InvalidUserCodeError,
    SmachError,
)
from gazelle.compat.smach.iterator import Iterator
from gazelle.compat.smach.log import (
    is_shutdown,
    logdebug,
    logerr,
    loginfo,
    logwarn,
    set_loggers,
    set_shutdown_check,
)
from gazelle.compat.smach.state import (
    CBInterface,
    CBState,
    State,
    cb_interface,
    has_smach_interface,
)
from gazelle.compat.smach.state_machine import Sequence, StateMachine
from gazelle.compat.smach.user_data import Remapper, UserData

_HERE = "gazelle.compat.smach"
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
