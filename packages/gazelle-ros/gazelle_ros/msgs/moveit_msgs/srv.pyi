# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from typing import ClassVar as _ClassVar
from gazelle_ros.messages import Message as _Message
from gazelle_ros.messages import ServiceDefinition as _ServiceDefinition
from gazelle_ros.msgs.geometry_msgs import msg as _geometry_msgs
from gazelle_ros.msgs.moveit_msgs import msg as _moveit_msgs
from gazelle_ros.msgs.sensor_msgs import msg as _sensor_msgs
from gazelle_ros.msgs.std_msgs import msg as _std_msgs

class ApplyPlanningSceneRequest(_Message):
    scene: _moveit_msgs.PlanningScene
    def __init__(self, scene: _moveit_msgs.PlanningScene | None = ...) -> None: ...
class ApplyPlanningSceneResponse(_Message):
    success: bool
    def __init__(self, success: bool | None = ...) -> None: ...
class ApplyPlanningScene(_ServiceDefinition):
    _request_class: _ClassVar[type[ApplyPlanningSceneRequest]]
    _response_class: _ClassVar[type[ApplyPlanningSceneResponse]]
class ChangeControlDimensionsRequest(_Message):
    control_x_translation: bool
    control_y_translation: bool
    control_z_translation: bool
    control_x_rotation: bool
    control_y_rotation: bool
    control_z_rotation: bool
    def __init__(self, control_x_translation: bool | None = ..., control_y_translation: bool | None = ..., control_z_translation: bool | None = ..., control_x_rotation: bool | None = ..., control_y_rotation: bool | None = ..., control_z_rotation: bool | None = ...) -> None: ...
class ChangeControlDimensionsResponse(_Message):
    success: bool
    def __init__(self, success: bool | None = ...) -> None: ...
class ChangeControlDimensions(_ServiceDefinition):
    _request_class: _ClassVar[type[ChangeControlDimensionsRequest]]
    _response_class: _ClassVar[type[ChangeControlDimensionsResponse]]
class ChangeDriftDimensionsRequest(_Message):
    drift_x_translation: bool
    drift_y_translation: bool
    drift_z_translation: bool
    drift_x_rotation: bool
    drift_y_rotation: bool
    drift_z_rotation: bool
    transform_jog_frame_to_drift_frame: _geometry_msgs.Transform
    def __init__(self, drift_x_translation: bool | None = ..., drift_y_translation: bool | None = ..., drift_z_translation: bool | None = ..., drift_x_rotation: bool | None = ..., drift_y_rotation: bool | None = ..., drift_z_rotation: bool | None = ..., transform_jog_frame_to_drift_frame: _geometry_msgs.Transform | None = ...) -> None: ...
class ChangeDriftDimensionsResponse(_Message):
    success: bool
    def __init__(self, success: bool | None = ...) -> None: ...
class ChangeDriftDimensions(_ServiceDefinition):
    _request_class: _ClassVar[type[ChangeDriftDimensionsRequest]]
    _response_class: _ClassVar[type[ChangeDriftDimensionsResponse]]
class CheckIfRobotStateExistsInWarehouseRequest(_Message):
    name: str
    robot: str
    def __init__(self, name: str | None = ..., robot: str | None = ...) -> None: ...
class CheckIfRobotStateExistsInWarehouseResponse(_Message):
    exists: bool
    def __init__(self, exists: bool | None = ...) -> None: ...
class CheckIfRobotStateExistsInWarehouse(_ServiceDefinition):
    _request_class: _ClassVar[type[CheckIfRobotStateExistsInWarehouseRequest]]
    _response_class: _ClassVar[type[CheckIfRobotStateExistsInWarehouseResponse]]
class DeleteRobotStateFromWarehouseRequest(_Message):
    name: str
    robot: str
    def __init__(self, name: str | None = ..., robot: str | None = ...) -> None: ...
class DeleteRobotStateFromWarehouseResponse(_Message):
    def __init__(self) -> None: ...
class DeleteRobotStateFromWarehouse(_ServiceDefinition):
    _request_class: _ClassVar[type[DeleteRobotStateFromWarehouseRequest]]
    _response_class: _ClassVar[type[DeleteRobotStateFromWarehouseResponse]]
class ExecuteKnownTrajectoryRequest(_Message):
    trajectory: _moveit_msgs.RobotTrajectory
    wait_for_execution: bool
    def __init__(self, trajectory: _moveit_msgs.RobotTrajectory | None = ..., wait_for_execution: bool | None = ...) -> None: ...
class ExecuteKnownTrajectoryResponse(_Message):
    error_code: _moveit_msgs.MoveItErrorCodes
    def __init__(self, error_code: _moveit_msgs.MoveItErrorCodes | None = ...) -> None: ...
class ExecuteKnownTrajectory(_ServiceDefinition):
    _request_class: _ClassVar[type[ExecuteKnownTrajectoryRequest]]
    _response_class: _ClassVar[type[ExecuteKnownTrajectoryResponse]]
class GetCartesianPathRequest(_Message):
    header: _std_msgs.Header
    start_state: _moveit_msgs.RobotState
    group_name: str
    link_name: str
    waypoints: list[_geometry_msgs.Pose]
    max_step: float
    jump_threshold: float
    prismatic_jump_threshold: float
    revolute_jump_threshold: float
    avoid_collisions: bool
    path_constraints: _moveit_msgs.Constraints
    cartesian_speed_limited_link: str
    max_cartesian_speed: float
    def __init__(self, header: _std_msgs.Header | None = ..., start_state: _moveit_msgs.RobotState | None = ..., group_name: str | None = ..., link_name: str | None = ..., waypoints: list[_geometry_msgs.Pose] | None = ..., max_step: float | None = ..., jump_threshold: float | None = ..., prismatic_jump_threshold: float | None = ..., revolute_jump_threshold: float | None = ..., avoid_collisions: bool | None = ..., path_constraints: _moveit_msgs.Constraints | None = ..., cartesian_speed_limited_link: str | None = ..., max_cartesian_speed: float | None = ...) -> None: ...
class GetCartesianPathResponse(_Message):
    start_state: _moveit_msgs.RobotState
    solution: _moveit_msgs.RobotTrajectory
    fraction: float
    error_code: _moveit_msgs.MoveItErrorCodes
    def __init__(self, start_state: _moveit_msgs.RobotState | None = ..., solution: _moveit_msgs.RobotTrajectory | None = ..., fraction: float | None = ..., error_code: _moveit_msgs.MoveItErrorCodes | None = ...) -> None: ...
class GetCartesianPath(_ServiceDefinition):
    _request_class: _ClassVar[type[GetCartesianPathRequest]]
    _response_class: _ClassVar[type[GetCartesianPathResponse]]
class GetMotionPlanRequest(_Message):
    motion_plan_request: _moveit_msgs.MotionPlanRequest
    def __init__(self, motion_plan_request: _moveit_msgs.MotionPlanRequest | None = ...) -> None: ...
class GetMotionPlanResponse(_Message):
    motion_plan_response: _moveit_msgs.MotionPlanResponse
    def __init__(self, motion_plan_response: _moveit_msgs.MotionPlanResponse | None = ...) -> None: ...
class GetMotionPlan(_ServiceDefinition):
    _request_class: _ClassVar[type[GetMotionPlanRequest]]
    _response_class: _ClassVar[type[GetMotionPlanResponse]]
class GetMotionSequenceRequest(_Message):
    request: _moveit_msgs.MotionSequenceRequest
    def __init__(self, request: _moveit_msgs.MotionSequenceRequest | None = ...) -> None: ...
class GetMotionSequenceResponse(_Message):
    response: _moveit_msgs.MotionSequenceResponse
    def __init__(self, response: _moveit_msgs.MotionSequenceResponse | None = ...) -> None: ...
class GetMotionSequence(_ServiceDefinition):
    _request_class: _ClassVar[type[GetMotionSequenceRequest]]
    _response_class: _ClassVar[type[GetMotionSequenceResponse]]
class GetPlannerParamsRequest(_Message):
    pipeline_id: str
    planner_config: str
    group: str
    def __init__(self, pipeline_id: str | None = ..., planner_config: str | None = ..., group: str | None = ...) -> None: ...
class GetPlannerParamsResponse(_Message):
    params: _moveit_msgs.PlannerParams
    def __init__(self, params: _moveit_msgs.PlannerParams | None = ...) -> None: ...
class GetPlannerParams(_ServiceDefinition):
    _request_class: _ClassVar[type[GetPlannerParamsRequest]]
    _response_class: _ClassVar[type[GetPlannerParamsResponse]]
class GetPlanningSceneRequest(_Message):
    components: _moveit_msgs.PlanningSceneComponents
    def __init__(self, components: _moveit_msgs.PlanningSceneComponents | None = ...) -> None: ...
class GetPlanningSceneResponse(_Message):
    scene: _moveit_msgs.PlanningScene
    def __init__(self, scene: _moveit_msgs.PlanningScene | None = ...) -> None: ...
class GetPlanningScene(_ServiceDefinition):
    _request_class: _ClassVar[type[GetPlanningSceneRequest]]
    _response_class: _ClassVar[type[GetPlanningSceneResponse]]
class GetPositionFKRequest(_Message):
    header: _std_msgs.Header
    fk_link_names: list[str]
    robot_state: _moveit_msgs.RobotState
    def __init__(self, header: _std_msgs.Header | None = ..., fk_link_names: list[str] | None = ..., robot_state: _moveit_msgs.RobotState | None = ...) -> None: ...
class GetPositionFKResponse(_Message):
    pose_stamped: list[_geometry_msgs.PoseStamped]
    fk_link_names: list[str]
    error_code: _moveit_msgs.MoveItErrorCodes
    def __init__(self, pose_stamped: list[_geometry_msgs.PoseStamped] | None = ..., fk_link_names: list[str] | None = ..., error_code: _moveit_msgs.MoveItErrorCodes | None = ...) -> None: ...
class GetPositionFK(_ServiceDefinition):
    _request_class: _ClassVar[type[GetPositionFKRequest]]
    _response_class: _ClassVar[type[GetPositionFKResponse]]
class GetPositionIKRequest(_Message):
    ik_request: _moveit_msgs.PositionIKRequest
    def __init__(self, ik_request: _moveit_msgs.PositionIKRequest | None = ...) -> None: ...
class GetPositionIKResponse(_Message):
    solution: _moveit_msgs.RobotState
    error_code: _moveit_msgs.MoveItErrorCodes
    def __init__(self, solution: _moveit_msgs.RobotState | None = ..., error_code: _moveit_msgs.MoveItErrorCodes | None = ...) -> None: ...
class GetPositionIK(_ServiceDefinition):
    _request_class: _ClassVar[type[GetPositionIKRequest]]
    _response_class: _ClassVar[type[GetPositionIKResponse]]
class GetRobotStateFromWarehouseRequest(_Message):
    name: str
    robot: str
    def __init__(self, name: str | None = ..., robot: str | None = ...) -> None: ...
class GetRobotStateFromWarehouseResponse(_Message):
    state: _moveit_msgs.RobotState
    def __init__(self, state: _moveit_msgs.RobotState | None = ...) -> None: ...
class GetRobotStateFromWarehouse(_ServiceDefinition):
    _request_class: _ClassVar[type[GetRobotStateFromWarehouseRequest]]
    _response_class: _ClassVar[type[GetRobotStateFromWarehouseResponse]]
class GetStateValidityRequest(_Message):
    robot_state: _moveit_msgs.RobotState
    group_name: str
    constraints: _moveit_msgs.Constraints
    def __init__(self, robot_state: _moveit_msgs.RobotState | None = ..., group_name: str | None = ..., constraints: _moveit_msgs.Constraints | None = ...) -> None: ...
class GetStateValidityResponse(_Message):
    valid: bool
    contacts: list[_moveit_msgs.ContactInformation]
    cost_sources: list[_moveit_msgs.CostSource]
    constraint_result: list[_moveit_msgs.ConstraintEvalResult]
    def __init__(self, valid: bool | None = ..., contacts: list[_moveit_msgs.ContactInformation] | None = ..., cost_sources: list[_moveit_msgs.CostSource] | None = ..., constraint_result: list[_moveit_msgs.ConstraintEvalResult] | None = ...) -> None: ...
class GetStateValidity(_ServiceDefinition):
    _request_class: _ClassVar[type[GetStateValidityRequest]]
    _response_class: _ClassVar[type[GetStateValidityResponse]]
class GraspPlanningRequest(_Message):
    group_name: str
    target: _moveit_msgs.CollisionObject
    support_surfaces: list[str]
    candidate_grasps: list[_moveit_msgs.Grasp]
    movable_obstacles: list[_moveit_msgs.CollisionObject]
    def __init__(self, group_name: str | None = ..., target: _moveit_msgs.CollisionObject | None = ..., support_surfaces: list[str] | None = ..., candidate_grasps: list[_moveit_msgs.Grasp] | None = ..., movable_obstacles: list[_moveit_msgs.CollisionObject] | None = ...) -> None: ...
class GraspPlanningResponse(_Message):
    grasps: list[_moveit_msgs.Grasp]
    error_code: _moveit_msgs.MoveItErrorCodes
    def __init__(self, grasps: list[_moveit_msgs.Grasp] | None = ..., error_code: _moveit_msgs.MoveItErrorCodes | None = ...) -> None: ...
class GraspPlanning(_ServiceDefinition):
    _request_class: _ClassVar[type[GraspPlanningRequest]]
    _response_class: _ClassVar[type[GraspPlanningResponse]]
class ListRobotStatesInWarehouseRequest(_Message):
    regex: str
    robot: str
    def __init__(self, regex: str | None = ..., robot: str | None = ...) -> None: ...
class ListRobotStatesInWarehouseResponse(_Message):
    states: list[str]
    def __init__(self, states: list[str] | None = ...) -> None: ...
class ListRobotStatesInWarehouse(_ServiceDefinition):
    _request_class: _ClassVar[type[ListRobotStatesInWarehouseRequest]]
    _response_class: _ClassVar[type[ListRobotStatesInWarehouseResponse]]
class LoadMapRequest(_Message):
    filename: str
    def __init__(self, filename: str | None = ...) -> None: ...
class LoadMapResponse(_Message):
    success: bool
    def __init__(self, success: bool | None = ...) -> None: ...
class LoadMap(_ServiceDefinition):
    _request_class: _ClassVar[type[LoadMapRequest]]
    _response_class: _ClassVar[type[LoadMapResponse]]
class QueryPlannerInterfacesRequest(_Message):
    def __init__(self) -> None: ...
class QueryPlannerInterfacesResponse(_Message):
    planner_interfaces: list[_moveit_msgs.PlannerInterfaceDescription]
    def __init__(self, planner_interfaces: list[_moveit_msgs.PlannerInterfaceDescription] | None = ...) -> None: ...
class QueryPlannerInterfaces(_ServiceDefinition):
    _request_class: _ClassVar[type[QueryPlannerInterfacesRequest]]
    _response_class: _ClassVar[type[QueryPlannerInterfacesResponse]]
class RenameRobotStateInWarehouseRequest(_Message):
    old_name: str
    new_name: str
    robot: str
    def __init__(self, old_name: str | None = ..., new_name: str | None = ..., robot: str | None = ...) -> None: ...
class RenameRobotStateInWarehouseResponse(_Message):
    def __init__(self) -> None: ...
class RenameRobotStateInWarehouse(_ServiceDefinition):
    _request_class: _ClassVar[type[RenameRobotStateInWarehouseRequest]]
    _response_class: _ClassVar[type[RenameRobotStateInWarehouseResponse]]
class SaveMapRequest(_Message):
    filename: str
    def __init__(self, filename: str | None = ...) -> None: ...
class SaveMapResponse(_Message):
    success: bool
    def __init__(self, success: bool | None = ...) -> None: ...
class SaveMap(_ServiceDefinition):
    _request_class: _ClassVar[type[SaveMapRequest]]
    _response_class: _ClassVar[type[SaveMapResponse]]
class SaveRobotStateToWarehouseRequest(_Message):
    name: str
    robot: str
    state: _moveit_msgs.RobotState
    def __init__(self, name: str | None = ..., robot: str | None = ..., state: _moveit_msgs.RobotState | None = ...) -> None: ...
class SaveRobotStateToWarehouseResponse(_Message):
    success: bool
    def __init__(self, success: bool | None = ...) -> None: ...
class SaveRobotStateToWarehouse(_ServiceDefinition):
    _request_class: _ClassVar[type[SaveRobotStateToWarehouseRequest]]
    _response_class: _ClassVar[type[SaveRobotStateToWarehouseResponse]]
class SetPlannerParamsRequest(_Message):
    pipeline_id: str
    planner_config: str
    group: str
    params: _moveit_msgs.PlannerParams
    replace: bool
    def __init__(self, pipeline_id: str | None = ..., planner_config: str | None = ..., group: str | None = ..., params: _moveit_msgs.PlannerParams | None = ..., replace: bool | None = ...) -> None: ...
class SetPlannerParamsResponse(_Message):
    def __init__(self) -> None: ...
class SetPlannerParams(_ServiceDefinition):
    _request_class: _ClassVar[type[SetPlannerParamsRequest]]
    _response_class: _ClassVar[type[SetPlannerParamsResponse]]
class UpdatePointcloudOctomapRequest(_Message):
    cloud: _sensor_msgs.PointCloud2
    def __init__(self, cloud: _sensor_msgs.PointCloud2 | None = ...) -> None: ...
class UpdatePointcloudOctomapResponse(_Message):
    success: bool
    def __init__(self, success: bool | None = ...) -> None: ...
class UpdatePointcloudOctomap(_ServiceDefinition):
    _request_class: _ClassVar[type[UpdatePointcloudOctomapRequest]]
    _response_class: _ClassVar[type[UpdatePointcloudOctomapResponse]]
