# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from typing import ClassVar as _ClassVar
from gazelle_ros.messages import Message as _Message
from gazelle_ros.messages import ServiceDefinition as _ServiceDefinition
from gazelle_ros.msgs.geometry_msgs import msg as _geometry_msgs
from gazelle_ros.msgs.octomap_msgs import msg as _octomap_msgs

class BoundingBoxQueryRequest(_Message):
    min: _geometry_msgs.Point
    max: _geometry_msgs.Point
    def __init__(self, min: _geometry_msgs.Point | None = ..., max: _geometry_msgs.Point | None = ...) -> None: ...
class BoundingBoxQueryResponse(_Message):
    def __init__(self) -> None: ...
class BoundingBoxQuery(_ServiceDefinition):
    _request_class: _ClassVar[type[BoundingBoxQueryRequest]]
    _response_class: _ClassVar[type[BoundingBoxQueryResponse]]
class GetOctomapRequest(_Message):
    def __init__(self) -> None: ...
class GetOctomapResponse(_Message):
    map: _octomap_msgs.Octomap
    def __init__(self, map: _octomap_msgs.Octomap | None = ...) -> None: ...
class GetOctomap(_ServiceDefinition):
    _request_class: _ClassVar[type[GetOctomapRequest]]
    _response_class: _ClassVar[type[GetOctomapResponse]]
