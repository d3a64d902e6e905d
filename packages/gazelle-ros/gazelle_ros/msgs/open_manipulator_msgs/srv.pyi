# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from collections.abc import Sequence as _Sequence
from typing import Any as _Any
from typing import ClassVar as _ClassVar
from numpy.typing import NDArray as _NDArray
from gazelle_ros.messages import Message as _Message
from gazelle_ros.messages import ServiceDefinition as _ServiceDefinition
from gazelle_ros.msgs.open_manipulator_msgs import msg as _open_manipulator_msgs
from gazelle_ros.msgs.std_msgs import msg as _std_msgs

class GetJointPositionRequest(_Message):
    planning_group: str
    def __init__(self, planning_group: str | None = ...) -> None: ...
class GetJointPositionResponse(_Message):
    joint_position: _open_manipulator_msgs.JointPosition
    def __init__(self, joint_position: _open_manipulator_msgs.JointPosition | None = ...) -> None: ...
class GetJointPosition(_ServiceDefinition):
    _request_class: _ClassVar[type[GetJointPositionRequest]]
    _response_class: _ClassVar[type[GetJointPositionResponse]]
class GetKinematicsPoseRequest(_Message):
    planning_group: str
    end_effector_name: str
    def __init__(self, planning_group: str | None = ..., end_effector_name: str | None = ...) -> None: ...
class GetKinematicsPoseResponse(_Message):
    header: _std_msgs.Header
    kinematics_pose: _open_manipulator_msgs.KinematicsPose
    def __init__(self, header: _std_msgs.Header | None = ..., kinematics_pose: _open_manipulator_msgs.KinematicsPose | None = ...) -> None: ...
class GetKinematicsPose(_ServiceDefinition):
    _request_class: _ClassVar[type[GetKinematicsPoseRequest]]
    _response_class: _ClassVar[type[GetKinematicsPoseResponse]]
class SetActuatorStateRequest(_Message):
    set_actuator_state: bool
    def __init__(self, set_actuator_state: bool | None = ...) -> None: ...
class SetActuatorStateResponse(_Message):
    is_planned: bool
    def __init__(self, is_planned: bool | None = ...) -> None: ...
class SetActuatorState(_ServiceDefinition):
    _request_class: _ClassVar[type[SetActuatorStateRequest]]
    _response_class: _ClassVar[type[SetActuatorStateResponse]]
class SetDrawingTrajectoryRequest(_Message):
    end_effector_name: str
    drawing_trajectory_name: str
    param: _Sequence[float] | _NDArray[_Any]
    path_time: float
    def __init__(self, end_effector_name: str | None = ..., drawing_trajectory_name: str | None = ..., param: _Sequence[float] | _NDArray[_Any] | None = ..., path_time: float | None = ...) -> None: ...
class SetDrawingTrajectoryResponse(_Message):
    is_planned: bool
    def __init__(self, is_planned: bool | None = ...) -> None: ...
class SetDrawingTrajectory(_ServiceDefinition):
    _request_class: _ClassVar[type[SetDrawingTrajectoryRequest]]
    _response_class: _ClassVar[type[SetDrawingTrajectoryResponse]]
class SetJointPositionRequest(_Message):
    planning_group: str
    joint_position: _open_manipulator_msgs.JointPosition
    path_time: float
    def __init__(self, planning_group: str | None = ..., joint_position: _open_manipulator_msgs.JointPosition | None = ..., path_time: float | None = ...) -> None: ...
class SetJointPositionResponse(_Message):
    is_planned: bool
    def __init__(self, is_planned: bool | None = ...) -> None: ...
class SetJointPosition(_ServiceDefinition):
    _request_class: _ClassVar[type[SetJointPositionRequest]]
    _response_class: _ClassVar[type[SetJointPositionResponse]]
class SetKinematicsPoseRequest(_Message):
    planning_group: str
    end_effector_name: str
    kinematics_pose: _open_manipulator_msgs.KinematicsPose
    path_time: float
    def __init__(self, planning_group: str | None = ..., end_effector_name: str | None = ..., kinematics_pose: _open_manipulator_msgs.KinematicsPose | None = ..., path_time: float | None = ...) -> None: ...
class SetKinematicsPoseResponse(_Message):
    is_planned: bool
    def __init__(self, is_planned: bool | None = ...) -> None: ...
class SetKinematicsPose(_ServiceDefinition):
    _request_class: _ClassVar[type[SetKinematicsPoseRequest]]
    _response_class: _ClassVar[type[SetKinematicsPoseResponse]]
