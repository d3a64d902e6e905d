# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from typing import ClassVar as _ClassVar
from gazelle_ros.messages import Message as _Message
from gazelle_ros.time import Duration as _Duration
from gazelle_ros.time import Time as _Time
from gazelle_ros.msgs.actionlib_msgs import msg as _actionlib_msgs
from gazelle_ros.msgs.geometry_msgs import msg as _geometry_msgs
from gazelle_ros.msgs.std_msgs import msg as _std_msgs

class LookupTransformAction(_Message):
    action_goal: LookupTransformActionGoal
    action_result: LookupTransformActionResult
    action_feedback: LookupTransformActionFeedback
    def __init__(self, action_goal: LookupTransformActionGoal | None = ..., action_result: LookupTransformActionResult | None = ..., action_feedback: LookupTransformActionFeedback | None = ...) -> None: ...
class LookupTransformActionFeedback(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    feedback: LookupTransformFeedback
    def __init__(self, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., feedback: LookupTransformFeedback | None = ...) -> None: ...
class LookupTransformActionGoal(_Message):
    header: _std_msgs.Header
    goal_id: _actionlib_msgs.GoalID
    goal: LookupTransformGoal
    def __init__(self, header: _std_msgs.Header | None = ..., goal_id: _actionlib_msgs.GoalID | None = ..., goal: LookupTransformGoal | None = ...) -> None: ...
class LookupTransformActionResult(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    result: LookupTransformResult
    def __init__(self, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., result: LookupTransformResult | None = ...) -> None: ...
class LookupTransformFeedback(_Message):
    def __init__(self) -> None: ...
class LookupTransformGoal(_Message):
    target_frame: str
    source_frame: str
    source_time: _Time
    timeout: _Duration
    target_time: _Time
    fixed_frame: str
    advanced: bool
    def __init__(self, target_frame: str | None = ..., source_frame: str | None = ..., source_time: _Time | None = ..., timeout: _Duration | None = ..., target_time: _Time | None = ..., fixed_frame: str | None = ..., advanced: bool | None = ...) -> None: ...
class LookupTransformResult(_Message):
    transform: _geometry_msgs.TransformStamped
    error: TF2Error
    def __init__(self, transform: _geometry_msgs.TransformStamped | None = ..., error: TF2Error | None = ...) -> None: ...
class TF2Error(_Message):
    NO_ERROR: _ClassVar[int]
    LOOKUP_ERROR: _ClassVar[int]
    CONNECTIVITY_ERROR: _ClassVar[int]
    EXTRAPOLATION_ERROR: _ClassVar[int]
    INVALID_ARGUMENT_ERROR: _ClassVar[int]
    TIMEOUT_ERROR: _ClassVar[int]
    TRANSFORM_ERROR: _ClassVar[int]
    error: int
    error_string: str
    def __init__(self, error: int | None = ..., error_string: str | None = ...) -> None: ...
class TFMessage(_Message):
    transforms: list[_geometry_msgs.TransformStamped]
    def __init__(self, transforms: list[_geometry_msgs.TransformStamped] | None = ...) -> None: ...
