"""The states of a goal, as its server and as its client see them.

Source: http://wiki.ros.org/actionlib/DetailedDescription.
"""

from __future__ import annotations

from typing import Any


class GoalStatus:
    """Status of a goal as the server reports it; the numbers of ``actionlib_msgs/GoalStatus``."""

    PENDING = 0
    ACTIVE = 1
    PREEMPTED = 2
    SUCCEEDED = 3
    ABORTED = 4
    REJECTED = 5
    PREEMPTING = 6
    RECALLING = 7
    RECALLED = 8
    LOST = 9


class _Names:
    """States with names."""

    @classmethod
    def to_string(cls, n: int) -> str:
        """Return the name of a state."""
        return name_of(cls, n)


class CommState(_Names):
    """States of a goal at its client."""

    WAITING_FOR_GOAL_ACK = 0
    PENDING = 1
    ACTIVE = 2
    WAITING_FOR_RESULT = 3
    WAITING_FOR_CANCEL_ACK = 4
    RECALLING = 5
    PREEMPTING = 6
    DONE = 7
    LOST = 8


class TerminalState(_Names):
    """Terminal states of a goal."""

    RECALLED = GoalStatus.RECALLED
    REJECTED = GoalStatus.REJECTED
    PREEMPTED = GoalStatus.PREEMPTED
    ABORTED = GoalStatus.ABORTED
    SUCCEEDED = GoalStatus.SUCCEEDED
    LOST = GoalStatus.LOST


class SimpleGoalState(_Names):
    """States of a simple client's goal."""

    PENDING = 0
    ACTIVE = 1
    DONE = 2


def name_of(states: Any, n: int) -> str:
    """Return the name of a state in a class of states."""
    name: str
    for name, value in vars(states).items():
        if name.isupper() and value == n:
            return name
    return "No such state"


FINAL = frozenset(
    {
        GoalStatus.RECALLED,
        GoalStatus.REJECTED,
        GoalStatus.PREEMPTED,
        GoalStatus.ABORTED,
        GoalStatus.SUCCEEDED,
        GoalStatus.LOST,
    }
)
"""States that a server never leaves."""

_C, _S = CommState, GoalStatus
_WAIT = _C.WAITING_FOR_RESULT
_CANCELLED = {
    _S.PENDING: (),
    _S.ACTIVE: (),
    _S.REJECTED: (_WAIT,),
    _S.PREEMPTED: (_C.PREEMPTING, _WAIT),
    _S.SUCCEEDED: (_C.PREEMPTING, _WAIT),
    _S.ABORTED: (_C.PREEMPTING, _WAIT),
    _S.PREEMPTING: (_C.PREEMPTING,),
}
_ACTIVATED = {
    _S.ACTIVE: (_C.ACTIVE,),
    _S.PREEMPTED: (_C.ACTIVE, _C.PREEMPTING, _WAIT),
    _S.SUCCEEDED: (_C.ACTIVE, _WAIT),
    _S.ABORTED: (_C.ACTIVE, _WAIT),
    _S.PREEMPTING: (_C.ACTIVE, _C.PREEMPTING),
}
_OVER: dict[int, tuple[int, ...]] = dict.fromkeys(
    (_S.REJECTED, _S.RECALLED, _S.PREEMPTED, _S.SUCCEEDED, _S.ABORTED), ()
)

TRANSITIONS: dict[int, dict[int, tuple[int, ...]]] = {
    _C.WAITING_FOR_GOAL_ACK: _ACTIVATED
    | {
        _S.PENDING: (_C.PENDING,),
        _S.REJECTED: (_C.PENDING, _WAIT),
        _S.RECALLING: (_C.PENDING, _C.RECALLING),
        _S.RECALLED: (_C.PENDING, _WAIT),
    },
    _C.PENDING: _ACTIVATED
    | {
        _S.PENDING: (),
        _S.REJECTED: (_WAIT,),
        _S.RECALLING: (_C.RECALLING,),
        _S.RECALLED: (_C.RECALLING, _WAIT),
    },
    _C.ACTIVE: {
        _S.ACTIVE: (),
        _S.PREEMPTED: (_C.PREEMPTING, _WAIT),
        _S.SUCCEEDED: (_WAIT,),
        _S.ABORTED: (_WAIT,),
        _S.PREEMPTING: (_C.PREEMPTING,),
    },
    _C.WAITING_FOR_RESULT: _OVER | {_S.ACTIVE: ()},
    _C.WAITING_FOR_CANCEL_ACK: _CANCELLED
    | {_S.RECALLING: (_C.RECALLING,), _S.RECALLED: (_C.RECALLING, _WAIT)},
    _C.RECALLING: _CANCELLED | {_S.RECALLING: (), _S.RECALLED: (_WAIT,)},
    _C.PREEMPTING: {
        _S.ACTIVE: (),
        _S.PREEMPTED: (_WAIT,),
        _S.SUCCEEDED: (_WAIT,),
        _S.ABORTED: (_WAIT,),
        _S.PREEMPTING: (),
    },
    _C.DONE: _OVER,
}
"""For each state of a client, and what the server says: the states to go through; what is missing
the server may not say."""
