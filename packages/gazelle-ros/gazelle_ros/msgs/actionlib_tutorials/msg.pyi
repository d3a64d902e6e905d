# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from collections.abc import Sequence as _Sequence
from typing import Any as _Any
from numpy.typing import NDArray as _NDArray
from gazelle_ros.messages import Message as _Message
from gazelle_ros.msgs.actionlib_msgs import msg as _actionlib_msgs
from gazelle_ros.msgs.std_msgs import msg as _std_msgs

class AveragingAction(_Message):
    action_goal: AveragingActionGoal
    action_result: AveragingActionResult
    action_feedback: AveragingActionFeedback
    def __init__(self, action_goal: AveragingActionGoal | None = ..., action_result: AveragingActionResult | None = ..., action_feedback: AveragingActionFeedback | None = ...) -> None: ...
class AveragingActionFeedback(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    feedback: AveragingFeedback
    def __init__(self, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., feedback: AveragingFeedback | None = ...) -> None: ...
class AveragingActionGoal(_Message):
    header: _std_msgs.Header
    goal_id: _actionlib_msgs.GoalID
    goal: AveragingGoal
    def __init__(self, header: _std_msgs.Header | None = ..., goal_id: _actionlib_msgs.GoalID | None = ..., goal: AveragingGoal | None = ...) -> None: ...
class AveragingActionResult(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    result: AveragingResult
    def __init__(self, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., result: AveragingResult | None = ...) -> None: ...
class AveragingFeedback(_Message):
    sample: int
    data: float
    mean: float
    std_dev: float
    def __init__(self, sample: int | None = ..., data: float | None = ..., mean: float | None = ..., std_dev: float | None = ...) -> None: ...
class AveragingGoal(_Message):
    samples: int
    def __init__(self, samples: int | None = ...) -> None: ...
class AveragingResult(_Message):
    mean: float
    std_dev: float
    def __init__(self, mean: float | None = ..., std_dev: float | None = ...) -> None: ...
class FibonacciAction(_Message):
    action_goal: FibonacciActionGoal
    action_result: FibonacciActionResult
    action_feedback: FibonacciActionFeedback
    def __init__(self, action_goal: FibonacciActionGoal | None = ..., action_result: FibonacciActionResult | None = ..., action_feedback: FibonacciActionFeedback | None = ...) -> None: ...
class FibonacciActionFeedback(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    feedback: FibonacciFeedback
    def __init__(self, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., feedback: FibonacciFeedback | None = ...) -> None: ...
class FibonacciActionGoal(_Message):
    header: _std_msgs.Header
    goal_id: _actionlib_msgs.GoalID
    goal: FibonacciGoal
    def __init__(self, header: _std_msgs.Header | None = ..., goal_id: _actionlib_msgs.GoalID | None = ..., goal: FibonacciGoal | None = ...) -> None: ...
class FibonacciActionResult(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    result: FibonacciResult
    def __init__(self, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., result: FibonacciResult | None = ...) -> None: ...
class FibonacciFeedback(_Message):
    sequence: _Sequence[int] | _NDArray[_Any]
    def __init__(self, sequence: _Sequence[int] | _NDArray[_Any] | None = ...) -> None: ...
class FibonacciGoal(_Message):
    order: int
    def __init__(self, order: int | None = ...) -> None: ...
class FibonacciResult(_Message):
    sequence: _Sequence[int] | _NDArray[_Any]
    def __init__(self, sequence: _Sequence[int] | _NDArray[_Any] | None = ...) -> None: ...
