# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from typing import ClassVar as _ClassVar
from gazelle_ros.messages import Message as _Message
from gazelle_ros.messages import ServiceDefinition as _ServiceDefinition
from gazelle_ros.msgs.object_recognition_msgs import msg as _object_recognition_msgs

class GetObjectInformationRequest(_Message):
    type: _object_recognition_msgs.ObjectType
    def __init__(self, type: _object_recognition_msgs.ObjectType | None = ...) -> None: ...
class GetObjectInformationResponse(_Message):
    information: _object_recognition_msgs.ObjectInformation
    def __init__(self, information: _object_recognition_msgs.ObjectInformation | None = ...) -> None: ...
class GetObjectInformation(_ServiceDefinition):
    _request_class: _ClassVar[type[GetObjectInformationRequest]]
    _response_class: _ClassVar[type[GetObjectInformationResponse]]
