# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from gazelle_ros.messages import Message as _Message
from gazelle_ros.msgs.actionlib_msgs import msg as _actionlib_msgs
from gazelle_ros.msgs.std_msgs import msg as _std_msgs

class JoyPriorityAction(_Message):
    action_goal: JoyPriorityActionGoal
    action_result: JoyPriorityActionResult
    action_feedback: JoyPriorityActionFeedback
    def __init__(self, action_goal: JoyPriorityActionGoal | None = ..., action_result: JoyPriorityActionResult | None = ..., action_feedback: JoyPriorityActionFeedback | None = ...) -> None: ...
class JoyPriorityActionFeedback(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    feedback: JoyPriorityFeedback
    def __init__(self, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., feedback: JoyPriorityFeedback | None = ...) -> None: ...
class JoyPriorityActionGoal(_Message):
    header: _std_msgs.Header
    goal_id: _actionlib_msgs.GoalID
    goal: JoyPriorityGoal
    def __init__(self, header: _std_msgs.Header | None = ..., goal_id: _actionlib_msgs.GoalID | None = ..., goal: JoyPriorityGoal | None = ...) -> None: ...
class JoyPriorityActionResult(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    result: JoyPriorityResult
    def __init__(self, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., result: JoyPriorityResult | None = ...) -> None: ...
class JoyPriorityFeedback(_Message):
    def __init__(self) -> None: ...
class JoyPriorityGoal(_Message):
    def __init__(self) -> None: ...
class JoyPriorityResult(_Message):
    def __init__(self) -> None: ...
class JoyTurboAction(_Message):
    action_goal: JoyTurboActionGoal
    action_result: JoyTurboActionResult
    action_feedback: JoyTurboActionFeedback
    def __init__(self, action_goal: JoyTurboActionGoal | None = ..., action_result: JoyTurboActionResult | None = ..., action_feedback: JoyTurboActionFeedback | None = ...) -> None: ...
class JoyTurboActionFeedback(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    feedback: JoyTurboFeedback
    def __init__(self, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., feedback: JoyTurboFeedback | None = ...) -> None: ...
class JoyTurboActionGoal(_Message):
    header: _std_msgs.Header
    goal_id: _actionlib_msgs.GoalID
    goal: JoyTurboGoal
    def __init__(self, header: _std_msgs.Header | None = ..., goal_id: _actionlib_msgs.GoalID | None = ..., goal: JoyTurboGoal | None = ...) -> None: ...
class JoyTurboActionResult(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    result: JoyTurboResult
    def __init__(self, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., result: JoyTurboResult | None = ...) -> None: ...
class JoyTurboFeedback(_Message):
    def __init__(self) -> None: ...
class JoyTurboGoal(_Message):
    def __init__(self) -> None: ...
class JoyTurboResult(_Message):
    def __init__(self) -> None: ...
