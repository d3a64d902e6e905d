# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from typing import ClassVar as _ClassVar
from gazelle_ros.messages import Message as _Message
from gazelle_ros.messages import ServiceDefinition as _ServiceDefinition
from gazelle_ros.msgs.industrial_msgs import msg as _industrial_msgs
from gazelle_ros.msgs.trajectory_msgs import msg as _trajectory_msgs

class CmdJointTrajectoryRequest(_Message):
    trajectory: _trajectory_msgs.JointTrajectory
    def __init__(self, trajectory: _trajectory_msgs.JointTrajectory | None = ...) -> None: ...
class CmdJointTrajectoryResponse(_Message):
    code: _industrial_msgs.ServiceReturnCode
    def __init__(self, code: _industrial_msgs.ServiceReturnCode | None = ...) -> None: ...
class CmdJointTrajectory(_ServiceDefinition):
    _request_class: _ClassVar[type[CmdJointTrajectoryRequest]]
    _response_class: _ClassVar[type[CmdJointTrajectoryResponse]]
class GetRobotInfoRequest(_Message):
    def __init__(self) -> None: ...
class GetRobotInfoResponse(_Message):
    controller: _industrial_msgs.DeviceInfo
    robots: list[_industrial_msgs.DeviceInfo]
    code: _industrial_msgs.ServiceReturnCode
    def __init__(self, controller: _industrial_msgs.DeviceInfo | None = ..., robots: list[_industrial_msgs.DeviceInfo] | None = ..., code: _industrial_msgs.ServiceReturnCode | None = ...) -> None: ...
class GetRobotInfo(_ServiceDefinition):
    _request_class: _ClassVar[type[GetRobotInfoRequest]]
    _response_class: _ClassVar[type[GetRobotInfoResponse]]
class SetDrivePowerRequest(_Message):
    drive_power: bool
    def __init__(self, drive_power: bool | None = ...) -> None: ...
class SetDrivePowerResponse(_Message):
    code: _industrial_msgs.ServiceReturnCode
    def __init__(self, code: _industrial_msgs.ServiceReturnCode | None = ...) -> None: ...
class SetDrivePower(_ServiceDefinition):
    _request_class: _ClassVar[type[SetDrivePowerRequest]]
    _response_class: _ClassVar[type[SetDrivePowerResponse]]
class SetRemoteLoggerLevelRequest(_Message):
    level: _industrial_msgs.DebugLevel
    def __init__(self, level: _industrial_msgs.DebugLevel | None = ...) -> None: ...
class SetRemoteLoggerLevelResponse(_Message):
    code: _industrial_msgs.ServiceReturnCode
    def __init__(self, code: _industrial_msgs.ServiceReturnCode | None = ...) -> None: ...
class SetRemoteLoggerLevel(_ServiceDefinition):
    _request_class: _ClassVar[type[SetRemoteLoggerLevelRequest]]
    _response_class: _ClassVar[type[SetRemoteLoggerLevelResponse]]
class StartMotionRequest(_Message):
    def __init__(self) -> None: ...
class StartMotionResponse(_Message):
    code: _industrial_msgs.ServiceReturnCode
    def __init__(self, code: _industrial_msgs.ServiceReturnCode | None = ...) -> None: ...
class StartMotion(_ServiceDefinition):
    _request_class: _ClassVar[type[StartMotionRequest]]
    _response_class: _ClassVar[type[StartMotionResponse]]
class StopMotionRequest(_Message):
    def __init__(self) -> None: ...
class StopMotionResponse(_Message):
    code: _industrial_msgs.ServiceReturnCode
    def __init__(self, code: _industrial_msgs.ServiceReturnCode | None = ...) -> None: ...
class StopMotion(_ServiceDefinition):
    _request_class: _ClassVar[type[StopMotionRequest]]
    _response_class: _ClassVar[type[StopMotionResponse]]
