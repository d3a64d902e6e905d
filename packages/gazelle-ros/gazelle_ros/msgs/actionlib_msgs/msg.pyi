# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from typing import ClassVar as _ClassVar
from gazelle_ros.messages import Message as _Message
from gazelle_ros.time import Time as _Time
from gazelle_ros.msgs.std_msgs import msg as _std_msgs

class GoalID(_Message):
    stamp: _Time
    id: str
    def __init__(self, stamp: _Time | None = ..., id: str | None = ...) -> None: ...
class GoalStatus(_Message):
    PENDING: _ClassVar[int]
    ACTIVE: _ClassVar[int]
    PREEMPTED: _ClassVar[int]
    SUCCEEDED: _ClassVar[int]
    ABORTED: _ClassVar[int]
    REJECTED: _ClassVar[int]
    PREEMPTING: _ClassVar[int]
    RECALLING: _ClassVar[int]
    RECALLED: _ClassVar[int]
    LOST: _ClassVar[int]
    goal_id: GoalID
    status: int
    text: str
    def __init__(self, goal_id: GoalID | None = ..., status: int | None = ..., text: str | None = ...) -> None: ...
class GoalStatusArray(_Message):
    header: _std_msgs.Header
    status_list: list[GoalStatus]
    def __init__(self, header: _std_msgs.Header | None = ..., status_list: list[GoalStatus] | None = ...) -> None: ...
