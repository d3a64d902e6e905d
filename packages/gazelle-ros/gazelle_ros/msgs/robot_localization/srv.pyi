# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from collections.abc import Sequence as _Sequence
from typing import Any as _Any
from typing import ClassVar as _ClassVar
from numpy.typing import NDArray as _NDArray
from gazelle_ros.messages import Message as _Message
from gazelle_ros.messages import ServiceDefinition as _ServiceDefinition
from gazelle_ros.time import Time as _Time
from gazelle_ros.msgs.geographic_msgs import msg as _geographic_msgs
from gazelle_ros.msgs.geometry_msgs import msg as _geometry_msgs

class FromLLRequest(_Message):
    ll_point: _geographic_msgs.GeoPoint
    def __init__(self, ll_point: _geographic_msgs.GeoPoint | None = ...) -> None: ...
class FromLLResponse(_Message):
    map_point: _geometry_msgs.Point
    def __init__(self, map_point: _geometry_msgs.Point | None = ...) -> None: ...
class FromLL(_ServiceDefinition):
    _request_class: _ClassVar[type[FromLLRequest]]
    _response_class: _ClassVar[type[FromLLResponse]]
class GetStateRequest(_Message):
    time_stamp: _Time
    frame_id: str
    def __init__(self, time_stamp: _Time | None = ..., frame_id: str | None = ...) -> None: ...
class GetStateResponse(_Message):
    state: _Sequence[float] | _NDArray[_Any]
    covariance: _Sequence[float] | _NDArray[_Any]
    def __init__(self, state: _Sequence[float] | _NDArray[_Any] | None = ..., covariance: _Sequence[float] | _NDArray[_Any] | None = ...) -> None: ...
class GetState(_ServiceDefinition):
    _request_class: _ClassVar[type[GetStateRequest]]
    _response_class: _ClassVar[type[GetStateResponse]]
class SetDatumRequest(_Message):
    geo_pose: _geographic_msgs.GeoPose
    def __init__(self, geo_pose: _geographic_msgs.GeoPose | None = ...) -> None: ...
class SetDatumResponse(_Message):
    def __init__(self) -> None: ...
class SetDatum(_ServiceDefinition):
    _request_class: _ClassVar[type[SetDatumRequest]]
    _response_class: _ClassVar[type[SetDatumResponse]]
class SetPoseRequest(_Message):
    pose: _geometry_msgs.PoseWithCovarianceStamped
    def __init__(self, pose: _geometry_msgs.PoseWithCovarianceStamped | None = ...) -> None: ...
class SetPoseResponse(_Message):
    def __init__(self) -> None: ...
class SetPose(_ServiceDefinition):
    _request_class: _ClassVar[type[SetPoseRequest]]
    _response_class: _ClassVar[type[SetPoseResponse]]
class SetUTMZoneRequest(_Message):
    utm_zone: str
    def __init__(self, utm_zone: str | None = ...) -> None: ...
class SetUTMZoneResponse(_Message):
    def __init__(self) -> None: ...
class SetUTMZone(_ServiceDefinition):
    _request_class: _ClassVar[type[SetUTMZoneRequest]]
    _response_class: _ClassVar[type[SetUTMZoneResponse]]
class ToLLRequest(_Message):
    map_point: _geometry_msgs.Point
    def __init__(self, map_point: _geometry_msgs.Point | None = ...) -> None: ...
class ToLLResponse(_Message):
    ll_point: _geographic_msgs.GeoPoint
    def __init__(self, ll_point: _geographic_msgs.GeoPoint | None = ...) -> None: ...
class ToLL(_ServiceDefinition):
    _request_class: _ClassVar[type[ToLLRequest]]
    _response_class: _ClassVar[type[ToLLResponse]]
class ToggleFilterProcessingRequest(_Message):
    on: bool
    def __init__(self, on: bool | None = ...) -> None: ...
class ToggleFilterProcessingResponse(_Message):
    status: bool
    def __init__(self, status: bool | None = ...) -> None: ...
class ToggleFilterProcessing(_ServiceDefinition):
    _request_class: _ClassVar[type[ToggleFilterProcessingRequest]]
    _response_class: _ClassVar[type[ToggleFilterProcessingResponse]]
