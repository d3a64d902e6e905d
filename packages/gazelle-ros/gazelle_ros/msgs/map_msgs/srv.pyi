# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from typing import ClassVar as _ClassVar
from gazelle_ros.messages import Message as _Message
from gazelle_ros.messages import ServiceDefinition as _ServiceDefinition
from gazelle_ros.msgs.map_msgs import msg as _map_msgs
from gazelle_ros.msgs.nav_msgs import msg as _nav_msgs
from gazelle_ros.msgs.sensor_msgs import msg as _sensor_msgs
from gazelle_ros.msgs.std_msgs import msg as _std_msgs

class GetMapROIRequest(_Message):
    x: float
    y: float
    l_x: float
    l_y: float
    def __init__(self, x: float | None = ..., y: float | None = ..., l_x: float | None = ..., l_y: float | None = ...) -> None: ...
class GetMapROIResponse(_Message):
    sub_map: _nav_msgs.OccupancyGrid
    def __init__(self, sub_map: _nav_msgs.OccupancyGrid | None = ...) -> None: ...
class GetMapROI(_ServiceDefinition):
    _request_class: _ClassVar[type[GetMapROIRequest]]
    _response_class: _ClassVar[type[GetMapROIResponse]]
class GetPointMapRequest(_Message):
    def __init__(self) -> None: ...
class GetPointMapResponse(_Message):
    map: _sensor_msgs.PointCloud2
    def __init__(self, map: _sensor_msgs.PointCloud2 | None = ...) -> None: ...
class GetPointMap(_ServiceDefinition):
    _request_class: _ClassVar[type[GetPointMapRequest]]
    _response_class: _ClassVar[type[GetPointMapResponse]]
class GetPointMapROIRequest(_Message):
    x: float
    y: float
    z: float
    r: float
    l_x: float
    l_y: float
    l_z: float
    def __init__(self, x: float | None = ..., y: float | None = ..., z: float | None = ..., r: float | None = ..., l_x: float | None = ..., l_y: float | None = ..., l_z: float | None = ...) -> None: ...
class GetPointMapROIResponse(_Message):
    sub_map: _sensor_msgs.PointCloud2
    def __init__(self, sub_map: _sensor_msgs.PointCloud2 | None = ...) -> None: ...
class GetPointMapROI(_ServiceDefinition):
    _request_class: _ClassVar[type[GetPointMapROIRequest]]
    _response_class: _ClassVar[type[GetPointMapROIResponse]]
class ProjectedMapsInfoRequest(_Message):
    projected_maps_info: list[_map_msgs.ProjectedMapInfo]
    def __init__(self, projected_maps_info: list[_map_msgs.ProjectedMapInfo] | None = ...) -> None: ...
class ProjectedMapsInfoResponse(_Message):
    def __init__(self) -> None: ...
class ProjectedMapsInfo(_ServiceDefinition):
    _request_class: _ClassVar[type[ProjectedMapsInfoRequest]]
    _response_class: _ClassVar[type[ProjectedMapsInfoResponse]]
class SaveMapRequest(_Message):
    filename: _std_msgs.String
    def __init__(self, filename: _std_msgs.String | None = ...) -> None: ...
class SaveMapResponse(_Message):
    def __init__(self) -> None: ...
class SaveMap(_ServiceDefinition):
    _request_class: _ClassVar[type[SaveMapRequest]]
    _response_class: _ClassVar[type[SaveMapResponse]]
class SetMapProjectionsRequest(_Message):
    def __init__(self) -> None: ...
class SetMapProjectionsResponse(_Message):
    projected_maps_info: list[_map_msgs.ProjectedMapInfo]
    def __init__(self, projected_maps_info: list[_map_msgs.ProjectedMapInfo] | None = ...) -> None: ...
class SetMapProjections(_ServiceDefinition):
    _request_class: _ClassVar[type[SetMapProjectionsRequest]]
    _response_class: _ClassVar[type[SetMapProjectionsResponse]]
