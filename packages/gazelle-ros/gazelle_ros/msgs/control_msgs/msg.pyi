# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from collections.abc import Sequence as _Sequence
from typing import Any as _Any
from typing import ClassVar as _ClassVar
from numpy.typing import NDArray as _NDArray
from gazelle_ros.messages import Message as _Message
from gazelle_ros.time import Duration as _Duration
from gazelle_ros.msgs.actionlib_msgs import msg as _actionlib_msgs
from gazelle_ros.msgs.geometry_msgs import msg as _geometry_msgs
from gazelle_ros.msgs.std_msgs import msg as _std_msgs
from gazelle_ros.msgs.trajectory_msgs import msg as _trajectory_msgs

class FollowJointTrajectoryAction(_Message):
    action_goal: FollowJointTrajectoryActionGoal
    action_result: FollowJointTrajectoryActionResult
    action_feedback: FollowJointTrajectoryActionFeedback
    def __init__(self, action_goal: FollowJointTrajectoryActionGoal | None = ..., action_result: FollowJointTrajectoryActionResult | None = ..., action_feedback: FollowJointTrajectoryActionFeedback | None = ...) -> None: ...
class FollowJointTrajectoryActionFeedback(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    feedback: FollowJointTrajectoryFeedback
    def __init__(self, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., feedback: FollowJointTrajectoryFeedback | None = ...) -> None: ...
class FollowJointTrajectoryActionGoal(_Message):
    header: _std_msgs.Header
    goal_id: _actionlib_msgs.GoalID
    goal: FollowJointTrajectoryGoal
    def __init__(self, header: _std_msgs.Header | None = ..., goal_id: _actionlib_msgs.GoalID | None = ..., goal: FollowJointTrajectoryGoal | None = ...) -> None: ...
class FollowJointTrajectoryActionResult(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    result: FollowJointTrajectoryResult
    def __init__(self, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., result: FollowJointTrajectoryResult | None = ...) -> None: ...
class FollowJointTrajectoryFeedback(_Message):
    header: _std_msgs.Header
    joint_names: list[str]
    desired: _trajectory_msgs.JointTrajectoryPoint
    actual: _trajectory_msgs.JointTrajectoryPoint
    error: _trajectory_msgs.JointTrajectoryPoint
    def __init__(self, header: _std_msgs.Header | None = ..., joint_names: list[str] | None = ..., desired: _trajectory_msgs.JointTrajectoryPoint | None = ..., actual: _trajectory_msgs.JointTrajectoryPoint | None = ..., error: _trajectory_msgs.JointTrajectoryPoint | None = ...) -> None: ...
class FollowJointTrajectoryGoal(_Message):
    trajectory: _trajectory_msgs.JointTrajectory
    path_tolerance: list[JointTolerance]
    goal_tolerance: list[JointTolerance]
    goal_time_tolerance: _Duration
    def __init__(self, trajectory: _trajectory_msgs.JointTrajectory | None = ..., path_tolerance: list[JointTolerance] | None = ..., goal_tolerance: list[JointTolerance] | None = ..., goal_time_tolerance: _Duration | None = ...) -> None: ...
class FollowJointTrajectoryResult(_Message):
    SUCCESSFUL: _ClassVar[int]
    INVALID_GOAL: _ClassVar[int]
    INVALID_JOINTS: _ClassVar[int]
    OLD_HEADER_TIMESTAMP: _ClassVar[int]
    PATH_TOLERANCE_VIOLATED: _ClassVar[int]
    GOAL_TOLERANCE_VIOLATED: _ClassVar[int]
    error_code: int
    error_string: str
    def __init__(self, error_code: int | None = ..., error_string: str | None = ...) -> None: ...
class GripperCommand(_Message):
    position: float
    max_effort: float
    def __init__(self, position: float | None = ..., max_effort: float | None = ...) -> None: ...
class GripperCommandAction(_Message):
    action_goal: GripperCommandActionGoal
    action_result: GripperCommandActionResult
    action_feedback: GripperCommandActionFeedback
    def __init__(self, action_goal: GripperCommandActionGoal | None = ..., action_result: GripperCommandActionResult | None = ..., action_feedback: GripperCommandActionFeedback | None = ...) -> None: ...
class GripperCommandActionFeedback(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    feedback: GripperCommandFeedback
    def __init__(self, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., feedback: GripperCommandFeedback | None = ...) -> None: ...
class GripperCommandActionGoal(_Message):
    header: _std_msgs.Header
    goal_id: _actionlib_msgs.GoalID
    goal: GripperCommandGoal
    def __init__(self, header: _std_msgs.Header | None = ..., goal_id: _actionlib_msgs.GoalID | None = ..., goal: GripperCommandGoal | None = ...) -> None: ...
class GripperCommandActionResult(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    result: GripperCommandResult
    def __init__(self, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., result: GripperCommandResult | None = ...) -> None: ...
class GripperCommandFeedback(_Message):
    position: float
    effort: float
    stalled: bool
    reached_goal: bool
    def __init__(self, position: float | None = ..., effort: float | None = ..., stalled: bool | None = ..., reached_goal: bool | None = ...) -> None: ...
class GripperCommandGoal(_Message):
    command: GripperCommand
    def __init__(self, command: GripperCommand | None = ...) -> None: ...
class GripperCommandResult(_Message):
    position: float
    effort: float
    stalled: bool
    reached_goal: bool
    def __init__(self, position: float | None = ..., effort: float | None = ..., stalled: bool | None = ..., reached_goal: bool | None = ...) -> None: ...
class JointControllerState(_Message):
    header: _std_msgs.Header
    set_point: float
    process_value: float
    process_value_dot: float
    error: float
    time_step: float
    command: float
    p: float
    i: float
    d: float
    i_clamp: float
    antiwindup: bool
    def __init__(self, header: _std_msgs.Header | None = ..., set_point: float | None = ..., process_value: float | None = ..., process_value_dot: float | None = ..., error: float | None = ..., time_step: float | None = ..., command: float | None = ..., p: float | None = ..., i: float | None = ..., d: float | None = ..., i_clamp: float | None = ..., antiwindup: bool | None = ...) -> None: ...
class JointJog(_Message):
    header: _std_msgs.Header
    joint_names: list[str]
    displacements: _Sequence[float] | _NDArray[_Any]
    velocities: _Sequence[float] | _NDArray[_Any]
    duration: float
    def __init__(self, header: _std_msgs.Header | None = ..., joint_names: list[str] | None = ..., displacements: _Sequence[float] | _NDArray[_Any] | None = ..., velocities: _Sequence[float] | _NDArray[_Any] | None = ..., duration: float | None = ...) -> None: ...
class JointTolerance(_Message):
    name: str
    position: float
    velocity: float
    acceleration: float
    def __init__(self, name: str | None = ..., position: float | None = ..., velocity: float | None = ..., acceleration: float | None = ...) -> None: ...
class JointTrajectoryAction(_Message):
    action_goal: JointTrajectoryActionGoal
    action_result: JointTrajectoryActionResult
    action_feedback: JointTrajectoryActionFeedback
    def __init__(self, action_goal: JointTrajectoryActionGoal | None = ..., action_result: JointTrajectoryActionResult | None = ..., action_feedback: JointTrajectoryActionFeedback | None = ...) -> None: ...
class JointTrajectoryActionFeedback(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    feedback: JointTrajectoryFeedback
    def __init__(self, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., feedback: JointTrajectoryFeedback | None = ...) -> None: ...
class JointTrajectoryActionGoal(_Message):
    header: _std_msgs.Header
    goal_id: _actionlib_msgs.GoalID
    goal: JointTrajectoryGoal
    def __init__(self, header: _std_msgs.Header | None = ..., goal_id: _actionlib_msgs.GoalID | None = ..., goal: JointTrajectoryGoal | None = ...) -> None: ...
class JointTrajectoryActionResult(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    result: JointTrajectoryResult
    def __init__(self, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., result: JointTrajectoryResult | None = ...) -> None: ...
class JointTrajectoryControllerState(_Message):
    header: _std_msgs.Header
    joint_names: list[str]
    desired: _trajectory_msgs.JointTrajectoryPoint
    actual: _trajectory_msgs.JointTrajectoryPoint
    error: _trajectory_msgs.JointTrajectoryPoint
    def __init__(self, header: _std_msgs.Header | None = ..., joint_names: list[str] | None = ..., desired: _trajectory_msgs.JointTrajectoryPoint | None = ..., actual: _trajectory_msgs.JointTrajectoryPoint | None = ..., error: _trajectory_msgs.JointTrajectoryPoint | None = ...) -> None: ...
class JointTrajectoryFeedback(_Message):
    def __init__(self) -> None: ...
class JointTrajectoryGoal(_Message):
    trajectory: _trajectory_msgs.JointTrajectory
    def __init__(self, trajectory: _trajectory_msgs.JointTrajectory | None = ...) -> None: ...
class JointTrajectoryResult(_Message):
    def __init__(self) -> None: ...
class PidState(_Message):
    header: _std_msgs.Header
    timestep: _Duration
    error: float
    error_dot: float
    p_error: float
    i_error: float
    d_error: float
    p_term: float
    i_term: float
    d_term: float
    i_max: float
    i_min: float
    output: float
    def __init__(self, header: _std_msgs.Header | None = ..., timestep: _Duration | None = ..., error: float | None = ..., error_dot: float | None = ..., p_error: float | None = ..., i_error: float | None = ..., d_error: float | None = ..., p_term: float | None = ..., i_term: float | None = ..., d_term: float | None = ..., i_max: float | None = ..., i_min: float | None = ..., output: float | None = ...) -> None: ...
class PointHeadAction(_Message):
    action_goal: PointHeadActionGoal
    action_result: PointHeadActionResult
    action_feedback: PointHeadActionFeedback
    def __init__(self, action_goal: PointHeadActionGoal | None = ..., action_result: PointHeadActionResult | None = ..., action_feedback: PointHeadActionFeedback | None = ...) -> None: ...
class PointHeadActionFeedback(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    feedback: PointHeadFeedback
    def __init__(self, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., feedback: PointHeadFeedback | None = ...) -> None: ...
class PointHeadActionGoal(_Message):
    header: _std_msgs.Header
    goal_id: _actionlib_msgs.GoalID
    goal: PointHeadGoal
    def __init__(self, header: _std_msgs.Header | None = ..., goal_id: _actionlib_msgs.GoalID | None = ..., goal: PointHeadGoal | None = ...) -> None: ...
class PointHeadActionResult(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    result: PointHeadResult
    def __init__(self, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., result: PointHeadResult | None = ...) -> None: ...
class PointHeadFeedback(_Message):
    pointing_angle_error: float
    def __init__(self, pointing_angle_error: float | None = ...) -> None: ...
class PointHeadGoal(_Message):
    target: _geometry_msgs.PointStamped
    pointing_axis: _geometry_msgs.Vector3
    pointing_frame: str
    min_duration: _Duration
    max_velocity: float
    def __init__(self, target: _geometry_msgs.PointStamped | None = ..., pointing_axis: _geometry_msgs.Vector3 | None = ..., pointing_frame: str | None = ..., min_duration: _Duration | None = ..., max_velocity: float | None = ...) -> None: ...
class PointHeadResult(_Message):
    def __init__(self) -> None: ...
class SingleJointPositionAction(_Message):
    action_goal: SingleJointPositionActionGoal
    action_result: SingleJointPositionActionResult
    action_feedback: SingleJointPositionActionFeedback
    def __init__(self, action_goal: SingleJointPositionActionGoal | None = ..., action_result: SingleJointPositionActionResult | None = ..., action_feedback: SingleJointPositionActionFeedback | None = ...) -> None: ...
class SingleJointPositionActionFeedback(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    feedback: SingleJointPositionFeedback
    def __init__(self, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., feedback: SingleJointPositionFeedback | None = ...) -> None: ...
class SingleJointPositionActionGoal(_Message):
    header: _std_msgs.Header
    goal_id: _actionlib_msgs.GoalID
    goal: SingleJointPositionGoal
    def __init__(self, header: _std_msgs.Header | None = ..., goal_id: _actionlib_msgs.GoalID | None = ..., goal: SingleJointPositionGoal | None = ...) -> None: ...
class SingleJointPositionActionResult(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    result: SingleJointPositionResult
    def __init__(self, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., result: SingleJointPositionResult | None = ...) -> None: ...
class SingleJointPositionFeedback(_Message):
    header: _std_msgs.Header
    position: float
    velocity: float
    error: float
    def __init__(self, header: _std_msgs.Header | None = ..., position: float | None = ..., velocity: float | None = ..., error: float | None = ...) -> None: ...
class SingleJointPositionGoal(_Message):
    position: float
    min_duration: _Duration
    max_velocity: float
    def __init__(self, position: float | None = ..., min_duration: _Duration | None = ..., max_velocity: float | None = ...) -> None: ...
class SingleJointPositionResult(_Message):
    def __init__(self) -> None: ...
