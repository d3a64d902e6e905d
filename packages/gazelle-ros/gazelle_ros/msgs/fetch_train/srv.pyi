# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from typing import ClassVar as _ClassVar
from gazelle_ros.messages import Message as _Message
from gazelle_ros.messages import ServiceDefinition as _ServiceDefinition
from gazelle_ros.msgs.geometry_msgs import msg as _geometry_msgs
from gazelle_ros.msgs.trajectory_msgs import msg as _trajectory_msgs

class EePoseRequest(_Message):
    def __init__(self) -> None: ...
class EePoseResponse(_Message):
    pose: _geometry_msgs.Pose
    def __init__(self, pose: _geometry_msgs.Pose | None = ...) -> None: ...
class EePose(_ServiceDefinition):
    _request_class: _ClassVar[type[EePoseRequest]]
    _response_class: _ClassVar[type[EePoseResponse]]
class EeRpyRequest(_Message):
    def __init__(self) -> None: ...
class EeRpyResponse(_Message):
    r: float
    p: float
    y: float
    def __init__(self, r: float | None = ..., p: float | None = ..., y: float | None = ...) -> None: ...
class EeRpy(_ServiceDefinition):
    _request_class: _ClassVar[type[EeRpyRequest]]
    _response_class: _ClassVar[type[EeRpyResponse]]
class EeTrajRequest(_Message):
    pose: _geometry_msgs.Pose
    def __init__(self, pose: _geometry_msgs.Pose | None = ...) -> None: ...
class EeTrajResponse(_Message):
    success: bool
    message: str
    def __init__(self, success: bool | None = ..., message: str | None = ...) -> None: ...
class EeTraj(_ServiceDefinition):
    _request_class: _ClassVar[type[EeTrajRequest]]
    _response_class: _ClassVar[type[EeTrajResponse]]
class JointTrajRequest(_Message):
    point: _trajectory_msgs.JointTrajectoryPoint
    def __init__(self, point: _trajectory_msgs.JointTrajectoryPoint | None = ...) -> None: ...
class JointTrajResponse(_Message):
    success: bool
    message: str
    def __init__(self, success: bool | None = ..., message: str | None = ...) -> None: ...
class JointTraj(_ServiceDefinition):
    _request_class: _ClassVar[type[JointTrajRequest]]
    _response_class: _ClassVar[type[JointTrajResponse]]
