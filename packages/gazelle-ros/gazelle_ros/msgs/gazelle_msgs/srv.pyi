# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from typing import ClassVar as _ClassVar
from gazelle_ros.messages import Message as _Message
from gazelle_ros.messages import ServiceDefinition as _ServiceDefinition
from gazelle_ros.time import Time as _Time
from gazelle_ros.msgs.geometry_msgs import msg as _geometry_msgs

class RestoreRequest(_Message):
    state: bytes
    def __init__(self, state: bytes | None = ...) -> None: ...
class RestoreResponse(_Message):
    success: bool
    status_message: str
    def __init__(self, success: bool | None = ..., status_message: str | None = ...) -> None: ...
class Restore(_ServiceDefinition):
    _request_class: _ClassVar[type[RestoreRequest]]
    _response_class: _ClassVar[type[RestoreResponse]]
class SeedRequest(_Message):
    seed: int
    def __init__(self, seed: int | None = ...) -> None: ...
class SeedResponse(_Message):
    success: bool
    status_message: str
    def __init__(self, success: bool | None = ..., status_message: str | None = ...) -> None: ...
class Seed(_ServiceDefinition):
    _request_class: _ClassVar[type[SeedRequest]]
    _response_class: _ClassVar[type[SeedResponse]]
class SetPoseRequest(_Message):
    name: str
    pose: _geometry_msgs.Pose
    def __init__(self, name: str | None = ..., pose: _geometry_msgs.Pose | None = ...) -> None: ...
class SetPoseResponse(_Message):
    success: bool
    status_message: str
    def __init__(self, success: bool | None = ..., status_message: str | None = ...) -> None: ...
class SetPose(_ServiceDefinition):
    _request_class: _ClassVar[type[SetPoseRequest]]
    _response_class: _ClassVar[type[SetPoseResponse]]
class SetRealTimeFactorRequest(_Message):
    real_time_factor: str
    def __init__(self, real_time_factor: str | None = ...) -> None: ...
class SetRealTimeFactorResponse(_Message):
    success: bool
    status_message: str
    def __init__(self, success: bool | None = ..., status_message: str | None = ...) -> None: ...
class SetRealTimeFactor(_ServiceDefinition):
    _request_class: _ClassVar[type[SetRealTimeFactorRequest]]
    _response_class: _ClassVar[type[SetRealTimeFactorResponse]]
class SnapshotRequest(_Message):
    def __init__(self) -> None: ...
class SnapshotResponse(_Message):
    success: bool
    status_message: str
    state: bytes
    def __init__(self, success: bool | None = ..., status_message: str | None = ..., state: bytes | None = ...) -> None: ...
class Snapshot(_ServiceDefinition):
    _request_class: _ClassVar[type[SnapshotRequest]]
    _response_class: _ClassVar[type[SnapshotResponse]]
class StepRequest(_Message):
    steps: int
    def __init__(self, steps: int | None = ...) -> None: ...
class StepResponse(_Message):
    success: bool
    status_message: str
    time: _Time
    def __init__(self, success: bool | None = ..., status_message: str | None = ..., time: _Time | None = ...) -> None: ...
class Step(_ServiceDefinition):
    _request_class: _ClassVar[type[StepRequest]]
    _response_class: _ClassVar[type[StepResponse]]
