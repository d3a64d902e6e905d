# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from typing import ClassVar as _ClassVar
from gazelle_ros.messages import Message as _Message
from gazelle_ros.time import Duration as _Duration
from gazelle_ros.msgs.actionlib_msgs import msg as _actionlib_msgs
from gazelle_ros.msgs.std_msgs import msg as _std_msgs

class TestAction(_Message):
    action_goal: TestActionGoal
    action_result: TestActionResult
    action_feedback: TestActionFeedback
    def __init__(self, action_goal: TestActionGoal | None = ..., action_result: TestActionResult | None = ..., action_feedback: TestActionFeedback | None = ...) -> None: ...
class TestActionFeedback(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    feedback: TestFeedback
    def __init__(self, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., feedback: TestFeedback | None = ...) -> None: ...
class TestActionGoal(_Message):
    header: _std_msgs.Header
    goal_id: _actionlib_msgs.GoalID
    goal: TestGoal
    def __init__(self, header: _std_msgs.Header | None = ..., goal_id: _actionlib_msgs.GoalID | None = ..., goal: TestGoal | None = ...) -> None: ...
class TestActionResult(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    result: TestResult
    def __init__(self, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., result: TestResult | None = ...) -> None: ...
class TestFeedback(_Message):
    feedback: int
    def __init__(self, feedback: int | None = ...) -> None: ...
class TestGoal(_Message):
    goal: int
    def __init__(self, goal: int | None = ...) -> None: ...
class TestRequestAction(_Message):
    action_goal: TestRequestActionGoal
    action_result: TestRequestActionResult
    action_feedback: TestRequestActionFeedback
    def __init__(self, action_goal: TestRequestActionGoal | None = ..., action_result: TestRequestActionResult | None = ..., action_feedback: TestRequestActionFeedback | None = ...) -> None: ...
class TestRequestActionFeedback(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    feedback: TestRequestFeedback
    def __init__(self, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., feedback: TestRequestFeedback | None = ...) -> None: ...
class TestRequestActionGoal(_Message):
    header: _std_msgs.Header
    goal_id: _actionlib_msgs.GoalID
    goal: TestRequestGoal
    def __init__(self, header: _std_msgs.Header | None = ..., goal_id: _actionlib_msgs.GoalID | None = ..., goal: TestRequestGoal | None = ...) -> None: ...
class TestRequestActionResult(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    result: TestRequestResult
    def __init__(self, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., result: TestRequestResult | None = ...) -> None: ...
class TestRequestFeedback(_Message):
    def __init__(self) -> None: ...
class TestRequestGoal(_Message):
    TERMINATE_SUCCESS: _ClassVar[int]
    TERMINATE_ABORTED: _ClassVar[int]
    TERMINATE_REJECTED: _ClassVar[int]
    TERMINATE_LOSE: _ClassVar[int]
    TERMINATE_DROP: _ClassVar[int]
    TERMINATE_EXCEPTION: _ClassVar[int]
    terminate_status: int
    ignore_cancel: bool
    result_text: str
    the_result: int
    is_simple_client: bool
    delay_accept: _Duration
    delay_terminate: _Duration
    pause_status: _Duration
    def __init__(self, terminate_status: int | None = ..., ignore_cancel: bool | None = ..., result_text: str | None = ..., the_result: int | None = ..., is_simple_client: bool | None = ..., delay_accept: _Duration | None = ..., delay_terminate: _Duration | None = ..., pause_status: _Duration | None = ...) -> None: ...
class TestRequestResult(_Message):
    the_result: int
    is_simple_server: bool
    def __init__(self, the_result: int | None = ..., is_simple_server: bool | None = ...) -> None: ...
class TestResult(_Message):
    result: int
    def __init__(self, result: int | None = ...) -> None: ...
class TwoIntsAction(_Message):
    action_goal: TwoIntsActionGoal
    action_result: TwoIntsActionResult
    action_feedback: TwoIntsActionFeedback
    def __init__(self, action_goal: TwoIntsActionGoal | None = ..., action_result: TwoIntsActionResult | None = ..., action_feedback: TwoIntsActionFeedback | None = ...) -> None: ...
class TwoIntsActionFeedback(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    feedback: TwoIntsFeedback
    def __init__(self, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., feedback: TwoIntsFeedback | None = ...) -> None: ...
class TwoIntsActionGoal(_Message):
    header: _std_msgs.Header
    goal_id: _actionlib_msgs.GoalID
    goal: TwoIntsGoal
    def __init__(self, header: _std_msgs.Header | None = ..., goal_id: _actionlib_msgs.GoalID | None = ..., goal: TwoIntsGoal | None = ...) -> None: ...
class TwoIntsActionResult(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    result: TwoIntsResult
    def __init__(self, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., result: TwoIntsResult | None = ...) -> None: ...
class TwoIntsFeedback(_Message):
    def __init__(self) -> None: ...
class TwoIntsGoal(_Message):
    a: int
    b: int
    def __init__(self, a: int | None = ..., b: int | None = ...) -> None: ...
class TwoIntsResult(_Message):
    sum: int
    def __init__(self, sum: int | None = ...) -> None: ...
