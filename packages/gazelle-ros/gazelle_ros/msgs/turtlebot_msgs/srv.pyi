# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from typing import ClassVar as _ClassVar
from gazelle_ros.messages import Message as _Message
from gazelle_ros.messages import ServiceDefinition as _ServiceDefinition

class SetFollowStateRequest(_Message):
    STOPPED: _ClassVar[int]
    FOLLOW: _ClassVar[int]
    state: int
    def __init__(self, state: int | None = ...) -> None: ...
class SetFollowStateResponse(_Message):
    OK: _ClassVar[int]
    ERROR: _ClassVar[int]
    result: int
    def __init__(self, result: int | None = ...) -> None: ...
class SetFollowState(_ServiceDefinition):
    _request_class: _ClassVar[type[SetFollowStateRequest]]
    _response_class: _ClassVar[type[SetFollowStateResponse]]
class TakePanoramaRequest(_Message):
    SNAPANDROTATE: _ClassVar[int]
    CONTINUOUS: _ClassVar[int]
    STOP: _ClassVar[int]
    mode: int
    pano_angle: float
    snap_interval: float
    rot_vel: float
    def __init__(self, mode: int | None = ..., pano_angle: float | None = ..., snap_interval: float | None = ..., rot_vel: float | None = ...) -> None: ...
class TakePanoramaResponse(_Message):
    STARTED: _ClassVar[int]
    IN_PROGRESS: _ClassVar[int]
    STOPPED: _ClassVar[int]
    status: int
    def __init__(self, status: int | None = ...) -> None: ...
class TakePanorama(_ServiceDefinition):
    _request_class: _ClassVar[type[TakePanoramaRequest]]
    _response_class: _ClassVar[type[TakePanoramaResponse]]
