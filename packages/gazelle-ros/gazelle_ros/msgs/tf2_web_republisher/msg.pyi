# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from gazelle_ros.messages import Message as _Message
from gazelle_ros.msgs.actionlib_msgs import msg as _actionlib_msgs
from gazelle_ros.msgs.geometry_msgs import msg as _geometry_msgs
from gazelle_ros.msgs.std_msgs import msg as _std_msgs

class TFArray(_Message):
    transforms: list[_geometry_msgs.TransformStamped]
    def __init__(self, transforms: list[_geometry_msgs.TransformStamped] | None = ...) -> None: ...
class TFSubscriptionAction(_Message):
    action_goal: TFSubscriptionActionGoal
    action_result: TFSubscriptionActionResult
    action_feedback: TFSubscriptionActionFeedback
    def __init__(self, action_goal: TFSubscriptionActionGoal | None = ..., action_result: TFSubscriptionActionResult | None = ..., action_feedback: TFSubscriptionActionFeedback | None = ...) -> None: ...
class TFSubscriptionActionFeedback(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    feedback: TFSubscriptionFeedback
    def __init__(self, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., feedback: TFSubscriptionFeedback | None = ...) -> None: ...
class TFSubscriptionActionGoal(_Message):
    header: _std_msgs.Header
    goal_id: _actionlib_msgs.GoalID
    goal: TFSubscriptionGoal
    def __init__(self, header: _std_msgs.Header | None = ..., goal_id: _actionlib_msgs.GoalID | None = ..., goal: TFSubscriptionGoal | None = ...) -> None: ...
class TFSubscriptionActionResult(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    result: TFSubscriptionResult
    def __init__(self, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., result: TFSubscriptionResult | None = ...) -> None: ...
class TFSubscriptionFeedback(_Message):
    transforms: list[_geometry_msgs.TransformStamped]
    def __init__(self, transforms: list[_geometry_msgs.TransformStamped] | None = ...) -> None: ...
class TFSubscriptionGoal(_Message):
    source_frames: list[str]
    target_frame: str
    angular_thres: float
    trans_thres: float
    rate: float
    def __init__(self, source_frames: list[str] | None = ..., target_frame: str | None = ..., angular_thres: float | None = ..., trans_thres: float | None = ..., rate: float | None = ...) -> None: ...
class TFSubscriptionResult(_Message):
    def __init__(self) -> None: ...
