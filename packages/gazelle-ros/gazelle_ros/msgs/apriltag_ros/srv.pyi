# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from typing import ClassVar as _ClassVar
from gazelle_ros.messages import Message as _Message
from gazelle_ros.messages import ServiceDefinition as _ServiceDefinition
from gazelle_ros.msgs.apriltag_ros import msg as _apriltag_ros
from gazelle_ros.msgs.sensor_msgs import msg as _sensor_msgs

class AnalyzeSingleImageRequest(_Message):
    full_path_where_to_get_image: str
    full_path_where_to_save_image: str
    camera_info: _sensor_msgs.CameraInfo
    def __init__(self, full_path_where_to_get_image: str | None = ..., full_path_where_to_save_image: str | None = ..., camera_info: _sensor_msgs.CameraInfo | None = ...) -> None: ...
class AnalyzeSingleImageResponse(_Message):
    tag_detections: _apriltag_ros.AprilTagDetectionArray
    def __init__(self, tag_detections: _apriltag_ros.AprilTagDetectionArray | None = ...) -> None: ...
class AnalyzeSingleImage(_ServiceDefinition):
    _request_class: _ClassVar[type[AnalyzeSingleImageRequest]]
    _response_class: _ClassVar[type[AnalyzeSingleImageResponse]]
