# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from typing import ClassVar as _ClassVar
from gazelle_ros.messages import Message as _Message
from gazelle_ros.messages import ServiceDefinition as _ServiceDefinition
from gazelle_ros.time import Time as _Time
from gazelle_ros.msgs.sensor_msgs import msg as _sensor_msgs

class AssembleScansRequest(_Message):
    begin: _Time
    end: _Time
    def __init__(self, begin: _Time | None = ..., end: _Time | None = ...) -> None: ...
class AssembleScansResponse(_Message):
    cloud: _sensor_msgs.PointCloud
    def __init__(self, cloud: _sensor_msgs.PointCloud | None = ...) -> None: ...
class AssembleScans(_ServiceDefinition):
    _request_class: _ClassVar[type[AssembleScansRequest]]
    _response_class: _ClassVar[type[AssembleScansResponse]]
class AssembleScans2Request(_Message):
    begin: _Time
    end: _Time
    def __init__(self, begin: _Time | None = ..., end: _Time | None = ...) -> None: ...
class AssembleScans2Response(_Message):
    cloud: _sensor_msgs.PointCloud2
    def __init__(self, cloud: _sensor_msgs.PointCloud2 | None = ...) -> None: ...
class AssembleScans2(_ServiceDefinition):
    _request_class: _ClassVar[type[AssembleScans2Request]]
    _response_class: _ClassVar[type[AssembleScans2Response]]
