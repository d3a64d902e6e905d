# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from gazelle_ros.messages import Message as _Message
from gazelle_ros.msgs.actionlib_msgs import msg as _actionlib_msgs
from gazelle_ros.msgs.geometry_msgs import msg as _geometry_msgs
from gazelle_ros.msgs.std_msgs import msg as _std_msgs

class MoveBaseAction(_Message):
    action_goal: MoveBaseActionGoal
    action_result: MoveBaseActionResult
    action_feedback: MoveBaseActionFeedback
    def __init__(self, action_goal: MoveBaseActionGoal | None = ..., action_result: MoveBaseActionResult | None = ..., action_feedback: MoveBaseActionFeedback | None = ...) -> None: ...
class MoveBaseActionFeedback(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    feedback: MoveBaseFeedback
    def __init__(self, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., feedback: MoveBaseFeedback | None = ...) -> None: ...
class MoveBaseActionGoal(_Message):
    header: _std_msgs.Header
    goal_id: _actionlib_msgs.GoalID
    goal: MoveBaseGoal
    def __init__(self, header: _std_msgs.Header | None = ..., goal_id: _actionlib_msgs.GoalID | None = ..., goal: MoveBaseGoal | None = ...) -> None: ...
class MoveBaseActionResult(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    result: MoveBaseResult
    def __init__(self, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., result: MoveBaseResult | None = ...) -> None: ...
class MoveBaseFeedback(_Message):
    base_position: _geometry_msgs.PoseStamped
    def __init__(self, base_position: _geometry_msgs.PoseStamped | None = ...) -> None: ...
class MoveBaseGoal(_Message):
    target_pose: _geometry_msgs.PoseStamped
    def __init__(self, target_pose: _geometry_msgs.PoseStamped | None = ...) -> None: ...
class MoveBaseResult(_Message):
    def __init__(self) -> None: ...
class RecoveryStatus(_Message):
    pose_stamped: _geometry_msgs.PoseStamped
    current_recovery_number: int
    total_number_of_recoveries: int
    recovery_behavior_name: str
    def __init__(self, pose_stamped: _geometry_msgs.PoseStamped | None = ..., current_recovery_number: int | None = ..., total_number_of_recoveries: int | None = ..., recovery_behavior_name: str | None = ...) -> None: ...
