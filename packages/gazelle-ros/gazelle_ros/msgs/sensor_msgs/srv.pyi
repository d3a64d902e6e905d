# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from typing import ClassVar as _ClassVar
from gazelle_ros.messages import Message as _Message
from gazelle_ros.messages import ServiceDefinition as _ServiceDefinition
from gazelle_ros.msgs.sensor_msgs import msg as _sensor_msgs

class SetCameraInfoRequest(_Message):
    camera_info: _sensor_msgs.CameraInfo
    def __init__(self, camera_info: _sensor_msgs.CameraInfo | None = ...) -> None: ...
class SetCameraInfoResponse(_Message):
    success: bool
    status_message: str
    def __init__(self, success: bool | None = ..., status_message: str | None = ...) -> None: ...
class SetCameraInfo(_ServiceDefinition):
    _request_class: _ClassVar[type[SetCameraInfoRequest]]
    _response_class: _ClassVar[type[SetCameraInfoResponse]]
