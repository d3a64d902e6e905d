# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from typing import ClassVar as _ClassVar
from gazelle_ros.messages import Message as _Message
from gazelle_ros.messages import ServiceDefinition as _ServiceDefinition
from gazelle_ros.msgs.geometry_msgs import msg as _geometry_msgs

class ResetMappingRequest(_Message):
    initial_pose: _geometry_msgs.Pose
    def __init__(self, initial_pose: _geometry_msgs.Pose | None = ...) -> None: ...
class ResetMappingResponse(_Message):
    def __init__(self) -> None: ...
class ResetMapping(_ServiceDefinition):
    _request_class: _ClassVar[type[ResetMappingRequest]]
    _response_class: _ClassVar[type[ResetMappingResponse]]
