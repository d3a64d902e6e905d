# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from collections.abc import Sequence as _Sequence
from typing import Any as _Any
from typing import ClassVar as _ClassVar
from numpy.typing import NDArray as _NDArray
from gazelle_ros.messages import Message as _Message
from gazelle_ros.messages import ServiceDefinition as _ServiceDefinition
from gazelle_ros.time import Duration as _Duration
from gazelle_ros.time import Time as _Time
from gazelle_ros.msgs.gazebo_msgs import msg as _gazebo_msgs
from gazelle_ros.msgs.geometry_msgs import msg as _geometry_msgs
from gazelle_ros.msgs.std_msgs import msg as _std_msgs
from gazelle_ros.msgs.trajectory_msgs import msg as _trajectory_msgs

class ApplyBodyWrenchRequest(_Message):
    body_name: str
    reference_frame: str
    reference_point: _geometry_msgs.Point
    wrench: _geometry_msgs.Wrench
    start_time: _Time
    duration: _Duration
    def __init__(self, body_name: str | None = ..., reference_frame: str | None = ..., reference_point: _geometry_msgs.Point | None = ..., wrench: _geometry_msgs.Wrench | None = ..., start_time: _Time | None = ..., duration: _Duration | None = ...) -> None: ...
class ApplyBodyWrenchResponse(_Message):
    success: bool
    status_message: str
    def __init__(self, success: bool | None = ..., status_message: str | None = ...) -> None: ...
class ApplyBodyWrench(_ServiceDefinition):
    _request_class: _ClassVar[type[ApplyBodyWrenchRequest]]
    _response_class: _ClassVar[type[ApplyBodyWrenchResponse]]
class ApplyJointEffortRequest(_Message):
    joint_name: str
    effort: float
    start_time: _Time
    duration: _Duration
    def __init__(self, joint_name: str | None = ..., effort: float | None = ..., start_time: _Time | None = ..., duration: _Duration | None = ...) -> None: ...
class ApplyJointEffortResponse(_Message):
    success: bool
    status_message: str
    def __init__(self, success: bool | None = ..., status_message: str | None = ...) -> None: ...
class ApplyJointEffort(_ServiceDefinition):
    _request_class: _ClassVar[type[ApplyJointEffortRequest]]
    _response_class: _ClassVar[type[ApplyJointEffortResponse]]
class BodyRequestRequest(_Message):
    body_name: str
    def __init__(self, body_name: str | None = ...) -> None: ...
class BodyRequestResponse(_Message):
    def __init__(self) -> None: ...
class BodyRequest(_ServiceDefinition):
    _request_class: _ClassVar[type[BodyRequestRequest]]
    _response_class: _ClassVar[type[BodyRequestResponse]]
class DeleteLightRequest(_Message):
    light_name: str
    def __init__(self, light_name: str | None = ...) -> None: ...
class DeleteLightResponse(_Message):
    success: bool
    status_message: str
    def __init__(self, success: bool | None = ..., status_message: str | None = ...) -> None: ...
class DeleteLight(_ServiceDefinition):
    _request_class: _ClassVar[type[DeleteLightRequest]]
    _response_class: _ClassVar[type[DeleteLightResponse]]
class DeleteModelRequest(_Message):
    model_name: str
    def __init__(self, model_name: str | None = ...) -> None: ...
class DeleteModelResponse(_Message):
    success: bool
    status_message: str
    def __init__(self, success: bool | None = ..., status_message: str | None = ...) -> None: ...
class DeleteModel(_ServiceDefinition):
    _request_class: _ClassVar[type[DeleteModelRequest]]
    _response_class: _ClassVar[type[DeleteModelResponse]]
class GetJointPropertiesRequest(_Message):
    joint_name: str
    def __init__(self, joint_name: str | None = ...) -> None: ...
class GetJointPropertiesResponse(_Message):
    REVOLUTE: _ClassVar[int]
    CONTINUOUS: _ClassVar[int]
    PRISMATIC: _ClassVar[int]
    FIXED: _ClassVar[int]
    BALL: _ClassVar[int]
    UNIVERSAL: _ClassVar[int]
    type: int
    damping: _Sequence[float] | _NDArray[_Any]
    position: _Sequence[float] | _NDArray[_Any]
    rate: _Sequence[float] | _NDArray[_Any]
    success: bool
    status_message: str
    def __init__(self, type: int | None = ..., damping: _Sequence[float] | _NDArray[_Any] | None = ..., position: _Sequence[float] | _NDArray[_Any] | None = ..., rate: _Sequence[float] | _NDArray[_Any] | None = ..., success: bool | None = ..., status_message: str | None = ...) -> None: ...
class GetJointProperties(_ServiceDefinition):
    _request_class: _ClassVar[type[GetJointPropertiesRequest]]
    _response_class: _ClassVar[type[GetJointPropertiesResponse]]
class GetLightPropertiesRequest(_Message):
    light_name: str
    def __init__(self, light_name: str | None = ...) -> None: ...
class GetLightPropertiesResponse(_Message):
    diffuse: _std_msgs.ColorRGBA
    attenuation_constant: float
    attenuation_linear: float
    attenuation_quadratic: float
    success: bool
    status_message: str
    def __init__(self, diffuse: _std_msgs.ColorRGBA | None = ..., attenuation_constant: float | None = ..., attenuation_linear: float | None = ..., attenuation_quadratic: float | None = ..., success: bool | None = ..., status_message: str | None = ...) -> None: ...
class GetLightProperties(_ServiceDefinition):
    _request_class: _ClassVar[type[GetLightPropertiesRequest]]
    _response_class: _ClassVar[type[GetLightPropertiesResponse]]
class GetLinkPropertiesRequest(_Message):
    link_name: str
    def __init__(self, link_name: str | None = ...) -> None: ...
class GetLinkPropertiesResponse(_Message):
    com: _geometry_msgs.Pose
    gravity_mode: bool
    mass: float
    ixx: float
    ixy: float
    ixz: float
    iyy: float
    iyz: float
    izz: float
    success: bool
    status_message: str
    def __init__(self, com: _geometry_msgs.Pose | None = ..., gravity_mode: bool | None = ..., mass: float | None = ..., ixx: float | None = ..., ixy: float | None = ..., ixz: float | None = ..., iyy: float | None = ..., iyz: float | None = ..., izz: float | None = ..., success: bool | None = ..., status_message: str | None = ...) -> None: ...
class GetLinkProperties(_ServiceDefinition):
    _request_class: _ClassVar[type[GetLinkPropertiesRequest]]
    _response_class: _ClassVar[type[GetLinkPropertiesResponse]]
class GetLinkStateRequest(_Message):
    link_name: str
    reference_frame: str
    def __init__(self, link_name: str | None = ..., reference_frame: str | None = ...) -> None: ...
class GetLinkStateResponse(_Message):
    link_state: _gazebo_msgs.LinkState
    success: bool
    status_message: str
    def __init__(self, link_state: _gazebo_msgs.LinkState | None = ..., success: bool | None = ..., status_message: str | None = ...) -> None: ...
class GetLinkState(_ServiceDefinition):
    _request_class: _ClassVar[type[GetLinkStateRequest]]
    _response_class: _ClassVar[type[GetLinkStateResponse]]
class GetModelPropertiesRequest(_Message):
    model_name: str
    def __init__(self, model_name: str | None = ...) -> None: ...
class GetModelPropertiesResponse(_Message):
    parent_model_name: str
    canonical_body_name: str
    body_names: list[str]
    geom_names: list[str]
    joint_names: list[str]
    child_model_names: list[str]
    is_static: bool
    success: bool
    status_message: str
    def __init__(self, parent_model_name: str | None = ..., canonical_body_name: str | None = ..., body_names: list[str] | None = ..., geom_names: list[str] | None = ..., joint_names: list[str] | None = ..., child_model_names: list[str] | None = ..., is_static: bool | None = ..., success: bool | None = ..., status_message: str | None = ...) -> None: ...
class GetModelProperties(_ServiceDefinition):
    _request_class: _ClassVar[type[GetModelPropertiesRequest]]
    _response_class: _ClassVar[type[GetModelPropertiesResponse]]
class GetModelStateRequest(_Message):
    model_name: str
    relative_entity_name: str
    def __init__(self, model_name: str | None = ..., relative_entity_name: str | None = ...) -> None: ...
class GetModelStateResponse(_Message):
    header: _std_msgs.Header
    pose: _geometry_msgs.Pose
    twist: _geometry_msgs.Twist
    success: bool
    status_message: str
    def __init__(self, header: _std_msgs.Header | None = ..., pose: _geometry_msgs.Pose | None = ..., twist: _geometry_msgs.Twist | None = ..., success: bool | None = ..., status_message: str | None = ...) -> None: ...
class GetModelState(_ServiceDefinition):
    _request_class: _ClassVar[type[GetModelStateRequest]]
    _response_class: _ClassVar[type[GetModelStateResponse]]
class GetPhysicsPropertiesRequest(_Message):
    def __init__(self) -> None: ...
class GetPhysicsPropertiesResponse(_Message):
    time_step: float
    pause: bool
    max_update_rate: float
    gravity: _geometry_msgs.Vector3
    ode_config: _gazebo_msgs.ODEPhysics
    success: bool
    status_message: str
    def __init__(self, time_step: float | None = ..., pause: bool | None = ..., max_update_rate: float | None = ..., gravity: _geometry_msgs.Vector3 | None = ..., ode_config: _gazebo_msgs.ODEPhysics | None = ..., success: bool | None = ..., status_message: str | None = ...) -> None: ...
class GetPhysicsProperties(_ServiceDefinition):
    _request_class: _ClassVar[type[GetPhysicsPropertiesRequest]]
    _response_class: _ClassVar[type[GetPhysicsPropertiesResponse]]
class GetWorldPropertiesRequest(_Message):
    def __init__(self) -> None: ...
class GetWorldPropertiesResponse(_Message):
    sim_time: float
    model_names: list[str]
    rendering_enabled: bool
    success: bool
    status_message: str
    def __init__(self, sim_time: float | None = ..., model_names: list[str] | None = ..., rendering_enabled: bool | None = ..., success: bool | None = ..., status_message: str | None = ...) -> None: ...
class GetWorldProperties(_ServiceDefinition):
    _request_class: _ClassVar[type[GetWorldPropertiesRequest]]
    _response_class: _ClassVar[type[GetWorldPropertiesResponse]]
class JointRequestRequest(_Message):
    joint_name: str
    def __init__(self, joint_name: str | None = ...) -> None: ...
class JointRequestResponse(_Message):
    def __init__(self) -> None: ...
class JointRequest(_ServiceDefinition):
    _request_class: _ClassVar[type[JointRequestRequest]]
    _response_class: _ClassVar[type[JointRequestResponse]]
class SetJointPropertiesRequest(_Message):
    joint_name: str
    ode_joint_config: _gazebo_msgs.ODEJointProperties
    def __init__(self, joint_name: str | None = ..., ode_joint_config: _gazebo_msgs.ODEJointProperties | None = ...) -> None: ...
class SetJointPropertiesResponse(_Message):
    success: bool
    status_message: str
    def __init__(self, success: bool | None = ..., status_message: str | None = ...) -> None: ...
class SetJointProperties(_ServiceDefinition):
    _request_class: _ClassVar[type[SetJointPropertiesRequest]]
    _response_class: _ClassVar[type[SetJointPropertiesResponse]]
class SetJointTrajectoryRequest(_Message):
    model_name: str
    joint_trajectory: _trajectory_msgs.JointTrajectory
    model_pose: _geometry_msgs.Pose
    set_model_pose: bool
    disable_physics_updates: bool
    def __init__(self, model_name: str | None = ..., joint_trajectory: _trajectory_msgs.JointTrajectory | None = ..., model_pose: _geometry_msgs.Pose | None = ..., set_model_pose: bool | None = ..., disable_physics_updates: bool | None = ...) -> None: ...
class SetJointTrajectoryResponse(_Message):
    success: bool
    status_message: str
    def __init__(self, success: bool | None = ..., status_message: str | None = ...) -> None: ...
class SetJointTrajectory(_ServiceDefinition):
    _request_class: _ClassVar[type[SetJointTrajectoryRequest]]
    _response_class: _ClassVar[type[SetJointTrajectoryResponse]]
class SetLightPropertiesRequest(_Message):
    light_name: str
    cast_shadows: bool
    diffuse: _std_msgs.ColorRGBA
    specular: _std_msgs.ColorRGBA
    attenuation_constant: float
    attenuation_linear: float
    attenuation_quadratic: float
    direction: _geometry_msgs.Vector3
    pose: _geometry_msgs.Pose
    def __init__(self, light_name: str | None = ..., cast_shadows: bool | None = ..., diffuse: _std_msgs.ColorRGBA | None = ..., specular: _std_msgs.ColorRGBA | None = ..., attenuation_constant: float | None = ..., attenuation_linear: float | None = ..., attenuation_quadratic: float | None = ..., direction: _geometry_msgs.Vector3 | None = ..., pose: _geometry_msgs.Pose | None = ...) -> None: ...
class SetLightPropertiesResponse(_Message):
    success: bool
    status_message: str
    def __init__(self, success: bool | None = ..., status_message: str | None = ...) -> None: ...
class SetLightProperties(_ServiceDefinition):
    _request_class: _ClassVar[type[SetLightPropertiesRequest]]
    _response_class: _ClassVar[type[SetLightPropertiesResponse]]
class SetLinkPropertiesRequest(_Message):
    link_name: str
    com: _geometry_msgs.Pose
    gravity_mode: bool
    mass: float
    ixx: float
    ixy: float
    ixz: float
    iyy: float
    iyz: float
    izz: float
    def __init__(self, link_name: str | None = ..., com: _geometry_msgs.Pose | None = ..., gravity_mode: bool | None = ..., mass: float | None = ..., ixx: float | None = ..., ixy: float | None = ..., ixz: float | None = ..., iyy: float | None = ..., iyz: float | None = ..., izz: float | None = ...) -> None: ...
class SetLinkPropertiesResponse(_Message):
    success: bool
    status_message: str
    def __init__(self, success: bool | None = ..., status_message: str | None = ...) -> None: ...
class SetLinkProperties(_ServiceDefinition):
    _request_class: _ClassVar[type[SetLinkPropertiesRequest]]
    _response_class: _ClassVar[type[SetLinkPropertiesResponse]]
class SetLinkStateRequest(_Message):
    link_state: _gazebo_msgs.LinkState
    def __init__(self, link_state: _gazebo_msgs.LinkState | None = ...) -> None: ...
class SetLinkStateResponse(_Message):
    success: bool
    status_message: str
    def __init__(self, success: bool | None = ..., status_message: str | None = ...) -> None: ...
class SetLinkState(_ServiceDefinition):
    _request_class: _ClassVar[type[SetLinkStateRequest]]
    _response_class: _ClassVar[type[SetLinkStateResponse]]
class SetModelConfigurationRequest(_Message):
    model_name: str
    urdf_param_name: str
    joint_names: list[str]
    joint_positions: _Sequence[float] | _NDArray[_Any]
    def __init__(self, model_name: str | None = ..., urdf_param_name: str | None = ..., joint_names: list[str] | None = ..., joint_positions: _Sequence[float] | _NDArray[_Any] | None = ...) -> None: ...
class SetModelConfigurationResponse(_Message):
    success: bool
    status_message: str
    def __init__(self, success: bool | None = ..., status_message: str | None = ...) -> None: ...
class SetModelConfiguration(_ServiceDefinition):
    _request_class: _ClassVar[type[SetModelConfigurationRequest]]
    _response_class: _ClassVar[type[SetModelConfigurationResponse]]
class SetModelStateRequest(_Message):
    model_state: _gazebo_msgs.ModelState
    def __init__(self, model_state: _gazebo_msgs.ModelState | None = ...) -> None: ...
class SetModelStateResponse(_Message):
    success: bool
    status_message: str
    def __init__(self, success: bool | None = ..., status_message: str | None = ...) -> None: ...
class SetModelState(_ServiceDefinition):
    _request_class: _ClassVar[type[SetModelStateRequest]]
    _response_class: _ClassVar[type[SetModelStateResponse]]
class SetPhysicsPropertiesRequest(_Message):
    time_step: float
    max_update_rate: float
    gravity: _geometry_msgs.Vector3
    ode_config: _gazebo_msgs.ODEPhysics
    def __init__(self, time_step: float | None = ..., max_update_rate: float | None = ..., gravity: _geometry_msgs.Vector3 | None = ..., ode_config: _gazebo_msgs.ODEPhysics | None = ...) -> None: ...
class SetPhysicsPropertiesResponse(_Message):
    success: bool
    status_message: str
    def __init__(self, success: bool | None = ..., status_message: str | None = ...) -> None: ...
class SetPhysicsProperties(_ServiceDefinition):
    _request_class: _ClassVar[type[SetPhysicsPropertiesRequest]]
    _response_class: _ClassVar[type[SetPhysicsPropertiesResponse]]
class SpawnModelRequest(_Message):
    model_name: str
    model_xml: str
    robot_namespace: str
    initial_pose: _geometry_msgs.Pose
    reference_frame: str
    def __init__(self, model_name: str | None = ..., model_xml: str | None = ..., robot_namespace: str | None = ..., initial_pose: _geometry_msgs.Pose | None = ..., reference_frame: str | None = ...) -> None: ...
class SpawnModelResponse(_Message):
    success: bool
    status_message: str
    def __init__(self, success: bool | None = ..., status_message: str | None = ...) -> None: ...
class SpawnModel(_ServiceDefinition):
    _request_class: _ClassVar[type[SpawnModelRequest]]
    _response_class: _ClassVar[type[SpawnModelResponse]]
