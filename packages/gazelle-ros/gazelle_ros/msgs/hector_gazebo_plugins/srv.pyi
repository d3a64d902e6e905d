# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from typing import ClassVar as _ClassVar
from gazelle_ros.messages import Message as _Message
from gazelle_ros.messages import ServiceDefinition as _ServiceDefinition
from gazelle_ros.msgs.geographic_msgs import msg as _geographic_msgs
from gazelle_ros.msgs.geometry_msgs import msg as _geometry_msgs

class SetBiasRequest(_Message):
    bias: _geometry_msgs.Vector3
    def __init__(self, bias: _geometry_msgs.Vector3 | None = ...) -> None: ...
class SetBiasResponse(_Message):
    def __init__(self) -> None: ...
class SetBias(_ServiceDefinition):
    _request_class: _ClassVar[type[SetBiasRequest]]
    _response_class: _ClassVar[type[SetBiasResponse]]
class SetReferenceGeoPoseRequest(_Message):
    geo_pose: _geographic_msgs.GeoPose
    def __init__(self, geo_pose: _geographic_msgs.GeoPose | None = ...) -> None: ...
class SetReferenceGeoPoseResponse(_Message):
    def __init__(self) -> None: ...
class SetReferenceGeoPose(_ServiceDefinition):
    _request_class: _ClassVar[type[SetReferenceGeoPoseRequest]]
    _response_class: _ClassVar[type[SetReferenceGeoPoseResponse]]
