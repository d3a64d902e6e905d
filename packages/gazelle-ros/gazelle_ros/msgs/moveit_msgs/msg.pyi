# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from collections.abc import Sequence as _Sequence
from typing import Any as _Any
from typing import ClassVar as _ClassVar
from numpy.typing import NDArray as _NDArray
from gazelle_ros.messages import Message as _Message
from gazelle_ros.time import Duration as _Duration
from gazelle_ros.msgs.actionlib_msgs import msg as _actionlib_msgs
from gazelle_ros.msgs.geometry_msgs import msg as _geometry_msgs
from gazelle_ros.msgs.object_recognition_msgs import msg as _object_recognition_msgs
from gazelle_ros.msgs.octomap_msgs import msg as _octomap_msgs
from gazelle_ros.msgs.sensor_msgs import msg as _sensor_msgs
from gazelle_ros.msgs.shape_msgs import msg as _shape_msgs
from gazelle_ros.msgs.std_msgs import msg as _std_msgs
from gazelle_ros.msgs.trajectory_msgs import msg as _trajectory_msgs

class AllowedCollisionEntry(_Message):
    enabled: list[bool]
    def __init__(self, enabled: list[bool] | None = ...) -> None: ...
class AllowedCollisionMatrix(_Message):
    entry_names: list[str]
    entry_values: list[AllowedCollisionEntry]
    default_entry_names: list[str]
    default_entry_values: list[bool]
    def __init__(self, entry_names: list[str] | None = ..., entry_values: list[AllowedCollisionEntry] | None = ..., default_entry_names: list[str] | None = ..., default_entry_values: list[bool] | None = ...) -> None: ...
class AttachedCollisionObject(_Message):
    link_name: str
    object: CollisionObject
    touch_links: list[str]
    detach_posture: _trajectory_msgs.JointTrajectory
    weight: float
    def __init__(self, link_name: str | None = ..., object: CollisionObject | None = ..., touch_links: list[str] | None = ..., detach_posture: _trajectory_msgs.JointTrajectory | None = ..., weight: float | None = ...) -> None: ...
class BoundingVolume(_Message):
    primitives: list[_shape_msgs.SolidPrimitive]
    primitive_poses: list[_geometry_msgs.Pose]
    meshes: list[_shape_msgs.Mesh]
    mesh_poses: list[_geometry_msgs.Pose]
    def __init__(self, primitives: list[_shape_msgs.SolidPrimitive] | None = ..., primitive_poses: list[_geometry_msgs.Pose] | None = ..., meshes: list[_shape_msgs.Mesh] | None = ..., mesh_poses: list[_geometry_msgs.Pose] | None = ...) -> None: ...
class CartesianPoint(_Message):
    pose: _geometry_msgs.Pose
    velocity: _geometry_msgs.Twist
    acceleration: _geometry_msgs.Accel
    def __init__(self, pose: _geometry_msgs.Pose | None = ..., velocity: _geometry_msgs.Twist | None = ..., acceleration: _geometry_msgs.Accel | None = ...) -> None: ...
class CartesianTrajectory(_Message):
    header: _std_msgs.Header
    tracked_frame: str
    points: list[CartesianTrajectoryPoint]
    def __init__(self, header: _std_msgs.Header | None = ..., tracked_frame: str | None = ..., points: list[CartesianTrajectoryPoint] | None = ...) -> None: ...
class CartesianTrajectoryPoint(_Message):
    point: CartesianPoint
    time_from_start: _Duration
    def __init__(self, point: CartesianPoint | None = ..., time_from_start: _Duration | None = ...) -> None: ...
class CollisionObject(_Message):
    ADD: _ClassVar[int]
    REMOVE: _ClassVar[int]
    APPEND: _ClassVar[int]
    MOVE: _ClassVar[int]
    header: _std_msgs.Header
    pose: _geometry_msgs.Pose
    id: str
    type: _object_recognition_msgs.ObjectType
    primitives: list[_shape_msgs.SolidPrimitive]
    primitive_poses: list[_geometry_msgs.Pose]
    meshes: list[_shape_msgs.Mesh]
    mesh_poses: list[_geometry_msgs.Pose]
    planes: list[_shape_msgs.Plane]
    plane_poses: list[_geometry_msgs.Pose]
    subframe_names: list[str]
    subframe_poses: list[_geometry_msgs.Pose]
    operation: int
    def __init__(self, header: _std_msgs.Header | None = ..., pose: _geometry_msgs.Pose | None = ..., id: str | None = ..., type: _object_recognition_msgs.ObjectType | None = ..., primitives: list[_shape_msgs.SolidPrimitive] | None = ..., primitive_poses: list[_geometry_msgs.Pose] | None = ..., meshes: list[_shape_msgs.Mesh] | None = ..., mesh_poses: list[_geometry_msgs.Pose] | None = ..., planes: list[_shape_msgs.Plane] | None = ..., plane_poses: list[_geometry_msgs.Pose] | None = ..., subframe_names: list[str] | None = ..., subframe_poses: list[_geometry_msgs.Pose] | None = ..., operation: int | None = ...) -> None: ...
class ConstraintEvalResult(_Message):
    result: bool
    distance: float
    def __init__(self, result: bool | None = ..., distance: float | None = ...) -> None: ...
class Constraints(_Message):
    name: str
    joint_constraints: list[JointConstraint]
    position_constraints: list[PositionConstraint]
    orientation_constraints: list[OrientationConstraint]
    visibility_constraints: list[VisibilityConstraint]
    def __init__(self, name: str | None = ..., joint_constraints: list[JointConstraint] | None = ..., position_constraints: list[PositionConstraint] | None = ..., orientation_constraints: list[OrientationConstraint] | None = ..., visibility_constraints: list[VisibilityConstraint] | None = ...) -> None: ...
class ContactInformation(_Message):
    ROBOT_LINK: _ClassVar[int]
    WORLD_OBJECT: _ClassVar[int]
    ROBOT_ATTACHED: _ClassVar[int]
    header: _std_msgs.Header
    position: _geometry_msgs.Point
    normal: _geometry_msgs.Vector3
    depth: float
    contact_body_1: str
    body_type_1: int
    contact_body_2: str
    body_type_2: int
    def __init__(self, header: _std_msgs.Header | None = ..., position: _geometry_msgs.Point | None = ..., normal: _geometry_msgs.Vector3 | None = ..., depth: float | None = ..., contact_body_1: str | None = ..., body_type_1: int | None = ..., contact_body_2: str | None = ..., body_type_2: int | None = ...) -> None: ...
class CostSource(_Message):
    cost_density: float
    aabb_min: _geometry_msgs.Vector3
    aabb_max: _geometry_msgs.Vector3
    def __init__(self, cost_density: float | None = ..., aabb_min: _geometry_msgs.Vector3 | None = ..., aabb_max: _geometry_msgs.Vector3 | None = ...) -> None: ...
class DisplayRobotState(_Message):
    state: RobotState
    highlight_links: list[ObjectColor]
    hide: bool
    def __init__(self, state: RobotState | None = ..., highlight_links: list[ObjectColor] | None = ..., hide: bool | None = ...) -> None: ...
class DisplayTrajectory(_Message):
    model_id: str
    trajectory: list[RobotTrajectory]
    trajectory_start: RobotState
    def __init__(self, model_id: str | None = ..., trajectory: list[RobotTrajectory] | None = ..., trajectory_start: RobotState | None = ...) -> None: ...
class ExecuteTrajectoryAction(_Message):
    action_goal: ExecuteTrajectoryActionGoal
    action_result: ExecuteTrajectoryActionResult
    action_feedback: ExecuteTrajectoryActionFeedback
    def __init__(self, action_goal: ExecuteTrajectoryActionGoal | None = ..., action_result: ExecuteTrajectoryActionResult | None = ..., action_feedback: ExecuteTrajectoryActionFeedback | None = ...) -> None: ...
class ExecuteTrajectoryActionFeedback(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    feedback: ExecuteTrajectoryFeedback
    def __init__(self, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., feedback: ExecuteTrajectoryFeedback | None = ...) -> None: ...
class ExecuteTrajectoryActionGoal(_Message):
    header: _std_msgs.Header
    goal_id: _actionlib_msgs.GoalID
    goal: ExecuteTrajectoryGoal
    def __init__(self, header: _std_msgs.Header | None = ..., goal_id: _actionlib_msgs.GoalID | None = ..., goal: ExecuteTrajectoryGoal | None = ...) -> None: ...
class ExecuteTrajectoryActionResult(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    result: ExecuteTrajectoryResult
    def __init__(self, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., result: ExecuteTrajectoryResult | None = ...) -> None: ...
class ExecuteTrajectoryFeedback(_Message):
    state: str
    def __init__(self, state: str | None = ...) -> None: ...
class ExecuteTrajectoryGoal(_Message):
    trajectory: RobotTrajectory
    def __init__(self, trajectory: RobotTrajectory | None = ...) -> None: ...
class ExecuteTrajectoryResult(_Message):
    error_code: MoveItErrorCodes
    def __init__(self, error_code: MoveItErrorCodes | None = ...) -> None: ...
class GenericTrajectory(_Message):
    header: _std_msgs.Header
    joint_trajectory: list[_trajectory_msgs.JointTrajectory]
    cartesian_trajectory: list[CartesianTrajectory]
    def __init__(self, header: _std_msgs.Header | None = ..., joint_trajectory: list[_trajectory_msgs.JointTrajectory] | None = ..., cartesian_trajectory: list[CartesianTrajectory] | None = ...) -> None: ...
class Grasp(_Message):
    id: str
    pre_grasp_posture: _trajectory_msgs.JointTrajectory
    grasp_posture: _trajectory_msgs.JointTrajectory
    grasp_pose: _geometry_msgs.PoseStamped
    grasp_quality: float
    pre_grasp_approach: GripperTranslation
    post_grasp_retreat: GripperTranslation
    post_place_retreat: GripperTranslation
    max_contact_force: float
    allowed_touch_objects: list[str]
    def __init__(self, id: str | None = ..., pre_grasp_posture: _trajectory_msgs.JointTrajectory | None = ..., grasp_posture: _trajectory_msgs.JointTrajectory | None = ..., grasp_pose: _geometry_msgs.PoseStamped | None = ..., grasp_quality: float | None = ..., pre_grasp_approach: GripperTranslation | None = ..., post_grasp_retreat: GripperTranslation | None = ..., post_place_retreat: GripperTranslation | None = ..., max_contact_force: float | None = ..., allowed_touch_objects: list[str] | None = ...) -> None: ...
class GripperTranslation(_Message):
    direction: _geometry_msgs.Vector3Stamped
    desired_distance: float
    min_distance: float
    def __init__(self, direction: _geometry_msgs.Vector3Stamped | None = ..., desired_distance: float | None = ..., min_distance: float | None = ...) -> None: ...
class JointConstraint(_Message):
    joint_name: str
    position: float
    tolerance_above: float
    tolerance_below: float
    weight: float
    def __init__(self, joint_name: str | None = ..., position: float | None = ..., tolerance_above: float | None = ..., tolerance_below: float | None = ..., weight: float | None = ...) -> None: ...
class JointLimits(_Message):
    joint_name: str
    has_position_limits: bool
    min_position: float
    max_position: float
    has_velocity_limits: bool
    max_velocity: float
    has_acceleration_limits: bool
    max_acceleration: float
    def __init__(self, joint_name: str | None = ..., has_position_limits: bool | None = ..., min_position: float | None = ..., max_position: float | None = ..., has_velocity_limits: bool | None = ..., max_velocity: float | None = ..., has_acceleration_limits: bool | None = ..., max_acceleration: float | None = ...) -> None: ...
class KinematicSolverInfo(_Message):
    joint_names: list[str]
    limits: list[JointLimits]
    link_names: list[str]
    def __init__(self, joint_names: list[str] | None = ..., limits: list[JointLimits] | None = ..., link_names: list[str] | None = ...) -> None: ...
class LinkPadding(_Message):
    link_name: str
    padding: float
    def __init__(self, link_name: str | None = ..., padding: float | None = ...) -> None: ...
class LinkScale(_Message):
    link_name: str
    scale: float
    def __init__(self, link_name: str | None = ..., scale: float | None = ...) -> None: ...
class MotionPlanDetailedResponse(_Message):
    trajectory_start: RobotState
    group_name: str
    trajectory: list[RobotTrajectory]
    description: list[str]
    processing_time: _Sequence[float] | _NDArray[_Any]
    error_code: MoveItErrorCodes
    def __init__(self, trajectory_start: RobotState | None = ..., group_name: str | None = ..., trajectory: list[RobotTrajectory] | None = ..., description: list[str] | None = ..., processing_time: _Sequence[float] | _NDArray[_Any] | None = ..., error_code: MoveItErrorCodes | None = ...) -> None: ...
class MotionPlanRequest(_Message):
    workspace_parameters: WorkspaceParameters
    start_state: RobotState
    goal_constraints: list[Constraints]
    path_constraints: Constraints
    trajectory_constraints: TrajectoryConstraints
    reference_trajectories: list[GenericTrajectory]
    pipeline_id: str
    planner_id: str
    group_name: str
    num_planning_attempts: int
    allowed_planning_time: float
    max_velocity_scaling_factor: float
    max_acceleration_scaling_factor: float
    cartesian_speed_limited_link: str
    max_cartesian_speed: float
    def __init__(self, workspace_parameters: WorkspaceParameters | None = ..., start_state: RobotState | None = ..., goal_constraints: list[Constraints] | None = ..., path_constraints: Constraints | None = ..., trajectory_constraints: TrajectoryConstraints | None = ..., reference_trajectories: list[GenericTrajectory] | None = ..., pipeline_id: str | None = ..., planner_id: str | None = ..., group_name: str | None = ..., num_planning_attempts: int | None = ..., allowed_planning_time: float | None = ..., max_velocity_scaling_factor: float | None = ..., max_acceleration_scaling_factor: float | None = ..., cartesian_speed_limited_link: str | None = ..., max_cartesian_speed: float | None = ...) -> None: ...
class MotionPlanResponse(_Message):
    trajectory_start: RobotState
    group_name: str
    trajectory: RobotTrajectory
    planning_time: float
    error_code: MoveItErrorCodes
    def __init__(self, trajectory_start: RobotState | None = ..., group_name: str | None = ..., trajectory: RobotTrajectory | None = ..., planning_time: float | None = ..., error_code: MoveItErrorCodes | None = ...) -> None: ...
class MotionSequenceItem(_Message):
    req: MotionPlanRequest
    blend_radius: float
    def __init__(self, req: MotionPlanRequest | None = ..., blend_radius: float | None = ...) -> None: ...
class MotionSequenceRequest(_Message):
    items: list[MotionSequenceItem]
    def __init__(self, items: list[MotionSequenceItem] | None = ...) -> None: ...
class MotionSequenceResponse(_Message):
    error_code: MoveItErrorCodes
    sequence_start: RobotState
    planned_trajectories: list[RobotTrajectory]
    planning_time: float
    def __init__(self, error_code: MoveItErrorCodes | None = ..., sequence_start: RobotState | None = ..., planned_trajectories: list[RobotTrajectory] | None = ..., planning_time: float | None = ...) -> None: ...
class MoveGroupAction(_Message):
    action_goal: MoveGroupActionGoal
    action_result: MoveGroupActionResult
    action_feedback: MoveGroupActionFeedback
    def __init__(self, action_goal: MoveGroupActionGoal | None = ..., action_result: MoveGroupActionResult | None = ..., action_feedback: MoveGroupActionFeedback | None = ...) -> None: ...
class MoveGroupActionFeedback(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    feedback: MoveGroupFeedback
    def __init__(self, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., feedback: MoveGroupFeedback | None = ...) -> None: ...
class MoveGroupActionGoal(_Message):
    header: _std_msgs.Header
    goal_id: _actionlib_msgs.GoalID
    goal: MoveGroupGoal
    def __init__(self, header: _std_msgs.Header | None = ..., goal_id: _actionlib_msgs.GoalID | None = ..., goal: MoveGroupGoal | None = ...) -> None: ...
class MoveGroupActionResult(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    result: MoveGroupResult
    def __init__(self, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., result: MoveGroupResult | None = ...) -> None: ...
class MoveGroupFeedback(_Message):
    state: str
    def __init__(self, state: str | None = ...) -> None: ...
class MoveGroupGoal(_Message):
    request: MotionPlanRequest
    planning_options: PlanningOptions
    def __init__(self, request: MotionPlanRequest | None = ..., planning_options: PlanningOptions | None = ...) -> None: ...
class MoveGroupResult(_Message):
    error_code: MoveItErrorCodes
    trajectory_start: RobotState
    planned_trajectory: RobotTrajectory
    executed_trajectory: RobotTrajectory
    planning_time: float
    def __init__(self, error_code: MoveItErrorCodes | None = ..., trajectory_start: RobotState | None = ..., planned_trajectory: RobotTrajectory | None = ..., executed_trajectory: RobotTrajectory | None = ..., planning_time: float | None = ...) -> None: ...
class MoveGroupSequenceAction(_Message):
    action_goal: MoveGroupSequenceActionGoal
    action_result: MoveGroupSequenceActionResult
    action_feedback: MoveGroupSequenceActionFeedback
    def __init__(self, action_goal: MoveGroupSequenceActionGoal | None = ..., action_result: MoveGroupSequenceActionResult | None = ..., action_feedback: MoveGroupSequenceActionFeedback | None = ...) -> None: ...
class MoveGroupSequenceActionFeedback(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    feedback: MoveGroupSequenceFeedback
    def __init__(self, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., feedback: MoveGroupSequenceFeedback | None = ...) -> None: ...
class MoveGroupSequenceActionGoal(_Message):
    header: _std_msgs.Header
    goal_id: _actionlib_msgs.GoalID
    goal: MoveGroupSequenceGoal
    def __init__(self, header: _std_msgs.Header | None = ..., goal_id: _actionlib_msgs.GoalID | None = ..., goal: MoveGroupSequenceGoal | None = ...) -> None: ...
class MoveGroupSequenceActionResult(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    result: MoveGroupSequenceResult
    def __init__(self, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., result: MoveGroupSequenceResult | None = ...) -> None: ...
class MoveGroupSequenceFeedback(_Message):
    state: str
    def __init__(self, state: str | None = ...) -> None: ...
class MoveGroupSequenceGoal(_Message):
    request: MotionSequenceRequest
    planning_options: PlanningOptions
    def __init__(self, request: MotionSequenceRequest | None = ..., planning_options: PlanningOptions | None = ...) -> None: ...
class MoveGroupSequenceResult(_Message):
    response: MotionSequenceResponse
    def __init__(self, response: MotionSequenceResponse | None = ...) -> None: ...
class MoveItErrorCodes(_Message):
    SUCCESS: _ClassVar[int]
    FAILURE: _ClassVar[int]
    PLANNING_FAILED: _ClassVar[int]
    INVALID_MOTION_PLAN: _ClassVar[int]
    MOTION_PLAN_INVALIDATED_BY_ENVIRONMENT_CHANGE: _ClassVar[int]
    CONTROL_FAILED: _ClassVar[int]
    UNABLE_TO_AQUIRE_SENSOR_DATA: _ClassVar[int]
    TIMED_OUT: _ClassVar[int]
    PREEMPTED: _ClassVar[int]
    START_STATE_IN_COLLISION: _ClassVar[int]
    START_STATE_VIOLATES_PATH_CONSTRAINTS: _ClassVar[int]
    START_STATE_INVALID: _ClassVar[int]
    GOAL_IN_COLLISION: _ClassVar[int]
    GOAL_VIOLATES_PATH_CONSTRAINTS: _ClassVar[int]
    GOAL_CONSTRAINTS_VIOLATED: _ClassVar[int]
    GOAL_STATE_INVALID: _ClassVar[int]
    UNRECOGNIZED_GOAL_TYPE: _ClassVar[int]
    INVALID_GROUP_NAME: _ClassVar[int]
    INVALID_GOAL_CONSTRAINTS: _ClassVar[int]
    INVALID_ROBOT_STATE: _ClassVar[int]
    INVALID_LINK_NAME: _ClassVar[int]
    INVALID_OBJECT_NAME: _ClassVar[int]
    FRAME_TRANSFORM_FAILURE: _ClassVar[int]
    COLLISION_CHECKING_UNAVAILABLE: _ClassVar[int]
    ROBOT_STATE_STALE: _ClassVar[int]
    SENSOR_INFO_STALE: _ClassVar[int]
    COMMUNICATION_FAILURE: _ClassVar[int]
    CRASH: _ClassVar[int]
    ABORT: _ClassVar[int]
    NO_IK_SOLUTION: _ClassVar[int]
    val: int
    def __init__(self, val: int | None = ...) -> None: ...
class ObjectColor(_Message):
    id: str
    color: _std_msgs.ColorRGBA
    def __init__(self, id: str | None = ..., color: _std_msgs.ColorRGBA | None = ...) -> None: ...
class OrientationConstraint(_Message):
    XYZ_EULER_ANGLES: _ClassVar[int]
    ROTATION_VECTOR: _ClassVar[int]
    header: _std_msgs.Header
    orientation: _geometry_msgs.Quaternion
    link_name: str
    absolute_x_axis_tolerance: float
    absolute_y_axis_tolerance: float
    absolute_z_axis_tolerance: float
    parameterization: int
    weight: float
    def __init__(self, header: _std_msgs.Header | None = ..., orientation: _geometry_msgs.Quaternion | None = ..., link_name: str | None = ..., absolute_x_axis_tolerance: float | None = ..., absolute_y_axis_tolerance: float | None = ..., absolute_z_axis_tolerance: float | None = ..., parameterization: int | None = ..., weight: float | None = ...) -> None: ...
class OrientedBoundingBox(_Message):
    pose: _geometry_msgs.Pose
    extents: _geometry_msgs.Point32
    def __init__(self, pose: _geometry_msgs.Pose | None = ..., extents: _geometry_msgs.Point32 | None = ...) -> None: ...
class PickupAction(_Message):
    action_goal: PickupActionGoal
    action_result: PickupActionResult
    action_feedback: PickupActionFeedback
    def __init__(self, action_goal: PickupActionGoal | None = ..., action_result: PickupActionResult | None = ..., action_feedback: PickupActionFeedback | None = ...) -> None: ...
class PickupActionFeedback(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    feedback: PickupFeedback
    def __init__(self, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., feedback: PickupFeedback | None = ...) -> None: ...
class PickupActionGoal(_Message):
    header: _std_msgs.Header
    goal_id: _actionlib_msgs.GoalID
    goal: PickupGoal
    def __init__(self, header: _std_msgs.Header | None = ..., goal_id: _actionlib_msgs.GoalID | None = ..., goal: PickupGoal | None = ...) -> None: ...
class PickupActionResult(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    result: PickupResult
    def __init__(self, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., result: PickupResult | None = ...) -> None: ...
class PickupFeedback(_Message):
    state: str
    def __init__(self, state: str | None = ...) -> None: ...
class PickupGoal(_Message):
    target_name: str
    group_name: str
    end_effector: str
    possible_grasps: list[Grasp]
    support_surface_name: str
    allow_gripper_support_collision: bool
    attached_object_touch_links: list[str]
    minimize_object_distance: bool
    path_constraints: Constraints
    planner_id: str
    allowed_touch_objects: list[str]
    allowed_planning_time: float
    planning_options: PlanningOptions
    def __init__(self, target_name: str | None = ..., group_name: str | None = ..., end_effector: str | None = ..., possible_grasps: list[Grasp] | None = ..., support_surface_name: str | None = ..., allow_gripper_support_collision: bool | None = ..., attached_object_touch_links: list[str] | None = ..., minimize_object_distance: bool | None = ..., path_constraints: Constraints | None = ..., planner_id: str | None = ..., allowed_touch_objects: list[str] | None = ..., allowed_planning_time: float | None = ..., planning_options: PlanningOptions | None = ...) -> None: ...
class PickupResult(_Message):
    error_code: MoveItErrorCodes
    trajectory_start: RobotState
    trajectory_stages: list[RobotTrajectory]
    trajectory_descriptions: list[str]
    grasp: Grasp
    planning_time: float
    def __init__(self, error_code: MoveItErrorCodes | None = ..., trajectory_start: RobotState | None = ..., trajectory_stages: list[RobotTrajectory] | None = ..., trajectory_descriptions: list[str] | None = ..., grasp: Grasp | None = ..., planning_time: float | None = ...) -> None: ...
class PlaceAction(_Message):
    action_goal: PlaceActionGoal
    action_result: PlaceActionResult
    action_feedback: PlaceActionFeedback
    def __init__(self, action_goal: PlaceActionGoal | None = ..., action_result: PlaceActionResult | None = ..., action_feedback: PlaceActionFeedback | None = ...) -> None: ...
class PlaceActionFeedback(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    feedback: PlaceFeedback
    def __init__(self, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., feedback: PlaceFeedback | None = ...) -> None: ...
class PlaceActionGoal(_Message):
    header: _std_msgs.Header
    goal_id: _actionlib_msgs.GoalID
    goal: PlaceGoal
    def __init__(self, header: _std_msgs.Header | None = ..., goal_id: _actionlib_msgs.GoalID | None = ..., goal: PlaceGoal | None = ...) -> None: ...
class PlaceActionResult(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    result: PlaceResult
    def __init__(self, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., result: PlaceResult | None = ...) -> None: ...
class PlaceFeedback(_Message):
    state: str
    def __init__(self, state: str | None = ...) -> None: ...
class PlaceGoal(_Message):
    group_name: str
    attached_object_name: str
    place_locations: list[PlaceLocation]
    place_eef: bool
    support_surface_name: str
    allow_gripper_support_collision: bool
    path_constraints: Constraints
    planner_id: str
    allowed_touch_objects: list[str]
    allowed_planning_time: float
    planning_options: PlanningOptions
    def __init__(self, group_name: str | None = ..., attached_object_name: str | None = ..., place_locations: list[PlaceLocation] | None = ..., place_eef: bool | None = ..., support_surface_name: str | None = ..., allow_gripper_support_collision: bool | None = ..., path_constraints: Constraints | None = ..., planner_id: str | None = ..., allowed_touch_objects: list[str] | None = ..., allowed_planning_time: float | None = ..., planning_options: PlanningOptions | None = ...) -> None: ...
class PlaceLocation(_Message):
    id: str
    post_place_posture: _trajectory_msgs.JointTrajectory
    place_pose: _geometry_msgs.PoseStamped
    quality: float
    pre_place_approach: GripperTranslation
    post_place_retreat: GripperTranslation
    allowed_touch_objects: list[str]
    def __init__(self, id: str | None = ..., post_place_posture: _trajectory_msgs.JointTrajectory | None = ..., place_pose: _geometry_msgs.PoseStamped | None = ..., quality: float | None = ..., pre_place_approach: GripperTranslation | None = ..., post_place_retreat: GripperTranslation | None = ..., allowed_touch_objects: list[str] | None = ...) -> None: ...
class PlaceResult(_Message):
    error_code: MoveItErrorCodes
    trajectory_start: RobotState
    trajectory_stages: list[RobotTrajectory]
    trajectory_descriptions: list[str]
    place_location: PlaceLocation
    planning_time: float
    def __init__(self, error_code: MoveItErrorCodes | None = ..., trajectory_start: RobotState | None = ..., trajectory_stages: list[RobotTrajectory] | None = ..., trajectory_descriptions: list[str] | None = ..., place_location: PlaceLocation | None = ..., planning_time: float | None = ...) -> None: ...
class PlannerInterfaceDescription(_Message):
    name: str
    pipeline_id: str
    planner_ids: list[str]
    def __init__(self, name: str | None = ..., pipeline_id: str | None = ..., planner_ids: list[str] | None = ...) -> None: ...
class PlannerParams(_Message):
    keys: list[str]
    values: list[str]
    descriptions: list[str]
    def __init__(self, keys: list[str] | None = ..., values: list[str] | None = ..., descriptions: list[str] | None = ...) -> None: ...
class PlanningOptions(_Message):
    planning_scene_diff: PlanningScene
    plan_only: bool
    look_around: bool
    look_around_attempts: int
    max_safe_execution_cost: float
    replan: bool
    replan_attempts: int
    replan_delay: float
    def __init__(self, planning_scene_diff: PlanningScene | None = ..., plan_only: bool | None = ..., look_around: bool | None = ..., look_around_attempts: int | None = ..., max_safe_execution_cost: float | None = ..., replan: bool | None = ..., replan_attempts: int | None = ..., replan_delay: float | None = ...) -> None: ...
class PlanningScene(_Message):
    name: str
    robot_state: RobotState
    robot_model_name: str
    fixed_frame_transforms: list[_geometry_msgs.TransformStamped]
    allowed_collision_matrix: AllowedCollisionMatrix
    link_padding: list[LinkPadding]
    link_scale: list[LinkScale]
    object_colors: list[ObjectColor]
    world: PlanningSceneWorld
    is_diff: bool
    def __init__(self, name: str | None = ..., robot_state: RobotState | None = ..., robot_model_name: str | None = ..., fixed_frame_transforms: list[_geometry_msgs.TransformStamped] | None = ..., allowed_collision_matrix: AllowedCollisionMatrix | None = ..., link_padding: list[LinkPadding] | None = ..., link_scale: list[LinkScale] | None = ..., object_colors: list[ObjectColor] | None = ..., world: PlanningSceneWorld | None = ..., is_diff: bool | None = ...) -> None: ...
class PlanningSceneComponents(_Message):
    SCENE_SETTINGS: _ClassVar[int]
    ROBOT_STATE: _ClassVar[int]
    ROBOT_STATE_ATTACHED_OBJECTS: _ClassVar[int]
    WORLD_OBJECT_NAMES: _ClassVar[int]
    WORLD_OBJECT_GEOMETRY: _ClassVar[int]
    OCTOMAP: _ClassVar[int]
    TRANSFORMS: _ClassVar[int]
    ALLOWED_COLLISION_MATRIX: _ClassVar[int]
    LINK_PADDING_AND_SCALING: _ClassVar[int]
    OBJECT_COLORS: _ClassVar[int]
    components: int
    def __init__(self, components: int | None = ...) -> None: ...
class PlanningSceneWorld(_Message):
    collision_objects: list[CollisionObject]
    octomap: _octomap_msgs.OctomapWithPose
    def __init__(self, collision_objects: list[CollisionObject] | None = ..., octomap: _octomap_msgs.OctomapWithPose | None = ...) -> None: ...
class PositionConstraint(_Message):
    header: _std_msgs.Header
    link_name: str
    target_point_offset: _geometry_msgs.Vector3
    constraint_region: BoundingVolume
    weight: float
    def __init__(self, header: _std_msgs.Header | None = ..., link_name: str | None = ..., target_point_offset: _geometry_msgs.Vector3 | None = ..., constraint_region: BoundingVolume | None = ..., weight: float | None = ...) -> None: ...
class PositionIKRequest(_Message):
    group_name: str
    robot_state: RobotState
    constraints: Constraints
    avoid_collisions: bool
    ik_link_name: str
    pose_stamped: _geometry_msgs.PoseStamped
    ik_link_names: list[str]
    pose_stamped_vector: list[_geometry_msgs.PoseStamped]
    timeout: _Duration
    def __init__(self, group_name: str | None = ..., robot_state: RobotState | None = ..., constraints: Constraints | None = ..., avoid_collisions: bool | None = ..., ik_link_name: str | None = ..., pose_stamped: _geometry_msgs.PoseStamped | None = ..., ik_link_names: list[str] | None = ..., pose_stamped_vector: list[_geometry_msgs.PoseStamped] | None = ..., timeout: _Duration | None = ...) -> None: ...
class RobotState(_Message):
    joint_state: _sensor_msgs.JointState
    multi_dof_joint_state: _sensor_msgs.MultiDOFJointState
    attached_collision_objects: list[AttachedCollisionObject]
    is_diff: bool
    def __init__(self, joint_state: _sensor_msgs.JointState | None = ..., multi_dof_joint_state: _sensor_msgs.MultiDOFJointState | None = ..., attached_collision_objects: list[AttachedCollisionObject] | None = ..., is_diff: bool | None = ...) -> None: ...
class RobotTrajectory(_Message):
    joint_trajectory: _trajectory_msgs.JointTrajectory
    multi_dof_joint_trajectory: _trajectory_msgs.MultiDOFJointTrajectory
    def __init__(self, joint_trajectory: _trajectory_msgs.JointTrajectory | None = ..., multi_dof_joint_trajectory: _trajectory_msgs.MultiDOFJointTrajectory | None = ...) -> None: ...
class TrajectoryConstraints(_Message):
    constraints: list[Constraints]
    def __init__(self, constraints: list[Constraints] | None = ...) -> None: ...
class VisibilityConstraint(_Message):
    SENSOR_Z: _ClassVar[int]
    SENSOR_Y: _ClassVar[int]
    SENSOR_X: _ClassVar[int]
    target_radius: float
    target_pose: _geometry_msgs.PoseStamped
    cone_sides: int
    sensor_pose: _geometry_msgs.PoseStamped
    max_view_angle: float
    max_range_angle: float
    sensor_view_direction: int
    weight: float
    def __init__(self, target_radius: float | None = ..., target_pose: _geometry_msgs.PoseStamped | None = ..., cone_sides: int | None = ..., sensor_pose: _geometry_msgs.PoseStamped | None = ..., max_view_angle: float | None = ..., max_range_angle: float | None = ..., sensor_view_direction: int | None = ..., weight: float | None = ...) -> None: ...
class WorkspaceParameters(_Message):
    header: _std_msgs.Header
    min_corner: _geometry_msgs.Vector3
    max_corner: _geometry_msgs.Vector3
    def __init__(self, header: _std_msgs.Header | None = ..., min_corner: _geometry_msgs.Vector3 | None = ..., max_corner: _geometry_msgs.Vector3 | None = ...) -> None: ...
