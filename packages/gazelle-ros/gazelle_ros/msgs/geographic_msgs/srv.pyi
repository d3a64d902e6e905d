# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from typing import ClassVar as _ClassVar
from gazelle_ros.messages import Message as _Message
from gazelle_ros.messages import ServiceDefinition as _ServiceDefinition
from gazelle_ros.msgs.geographic_msgs import msg as _geographic_msgs
from gazelle_ros.msgs.uuid_msgs import msg as _uuid_msgs

class GetGeoPathRequest(_Message):
    start: _geographic_msgs.GeoPoint
    goal: _geographic_msgs.GeoPoint
    def __init__(self, start: _geographic_msgs.GeoPoint | None = ..., goal: _geographic_msgs.GeoPoint | None = ...) -> None: ...
class GetGeoPathResponse(_Message):
    success: bool
    status: str
    plan: _geographic_msgs.GeoPath
    network: _uuid_msgs.UniqueID
    start_seg: _uuid_msgs.UniqueID
    goal_seg: _uuid_msgs.UniqueID
    distance: float
    def __init__(self, success: bool | None = ..., status: str | None = ..., plan: _geographic_msgs.GeoPath | None = ..., network: _uuid_msgs.UniqueID | None = ..., start_seg: _uuid_msgs.UniqueID | None = ..., goal_seg: _uuid_msgs.UniqueID | None = ..., distance: float | None = ...) -> None: ...
class GetGeoPath(_ServiceDefinition):
    _request_class: _ClassVar[type[GetGeoPathRequest]]
    _response_class: _ClassVar[type[GetGeoPathResponse]]
class GetGeographicMapRequest(_Message):
    url: str
    bounds: _geographic_msgs.BoundingBox
    def __init__(self, url: str | None = ..., bounds: _geographic_msgs.BoundingBox | None = ...) -> None: ...
class GetGeographicMapResponse(_Message):
    success: bool
    status: str
    map: _geographic_msgs.GeographicMap
    def __init__(self, success: bool | None = ..., status: str | None = ..., map: _geographic_msgs.GeographicMap | None = ...) -> None: ...
class GetGeographicMap(_ServiceDefinition):
    _request_class: _ClassVar[type[GetGeographicMapRequest]]
    _response_class: _ClassVar[type[GetGeographicMapResponse]]
class GetRoutePlanRequest(_Message):
    network: _uuid_msgs.UniqueID
    start: _uuid_msgs.UniqueID
    goal: _uuid_msgs.UniqueID
    def __init__(self, network: _uuid_msgs.UniqueID | None = ..., start: _uuid_msgs.UniqueID | None = ..., goal: _uuid_msgs.UniqueID | None = ...) -> None: ...
class GetRoutePlanResponse(_Message):
    success: bool
    status: str
    plan: _geographic_msgs.RoutePath
    def __init__(self, success: bool | None = ..., status: str | None = ..., plan: _geographic_msgs.RoutePath | None = ...) -> None: ...
class GetRoutePlan(_ServiceDefinition):
    _request_class: _ClassVar[type[GetRoutePlanRequest]]
    _response_class: _ClassVar[type[GetRoutePlanResponse]]
class UpdateGeographicMapRequest(_Message):
    updates: _geographic_msgs.GeographicMapChanges
    def __init__(self, updates: _geographic_msgs.GeographicMapChanges | None = ...) -> None: ...
class UpdateGeographicMapResponse(_Message):
    success: bool
    status: str
    def __init__(self, success: bool | None = ..., status: str | None = ...) -> None: ...
class UpdateGeographicMap(_ServiceDefinition):
    _request_class: _ClassVar[type[UpdateGeographicMapRequest]]
    _response_class: _ClassVar[type[UpdateGeographicMapResponse]]
