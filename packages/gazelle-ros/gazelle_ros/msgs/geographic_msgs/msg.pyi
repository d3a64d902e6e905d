# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from collections.abc import Sequence as _Sequence
from typing import Any as _Any
from numpy.typing import NDArray as _NDArray
from gazelle_ros.messages import Message as _Message
from gazelle_ros.msgs.geometry_msgs import msg as _geometry_msgs
from gazelle_ros.msgs.std_msgs import msg as _std_msgs
from gazelle_ros.msgs.uuid_msgs import msg as _uuid_msgs

class BoundingBox(_Message):
    min_pt: GeoPoint
    max_pt: GeoPoint
    def __init__(self, min_pt: GeoPoint | None = ..., max_pt: GeoPoint | None = ...) -> None: ...
class GeoPath(_Message):
    header: _std_msgs.Header
    poses: list[GeoPoseStamped]
    def __init__(self, header: _std_msgs.Header | None = ..., poses: list[GeoPoseStamped] | None = ...) -> None: ...
class GeoPoint(_Message):
    latitude: float
    longitude: float
    altitude: float
    def __init__(self, latitude: float | None = ..., longitude: float | None = ..., altitude: float | None = ...) -> None: ...
class GeoPointStamped(_Message):
    header: _std_msgs.Header
    position: GeoPoint
    def __init__(self, header: _std_msgs.Header | None = ..., position: GeoPoint | None = ...) -> None: ...
class GeoPose(_Message):
    position: GeoPoint
    orientation: _geometry_msgs.Quaternion
    def __init__(self, position: GeoPoint | None = ..., orientation: _geometry_msgs.Quaternion | None = ...) -> None: ...
class GeoPoseStamped(_Message):
    header: _std_msgs.Header
    pose: GeoPose
    def __init__(self, header: _std_msgs.Header | None = ..., pose: GeoPose | None = ...) -> None: ...
class GeoPoseWithCovariance(_Message):
    pose: GeoPose
    covariance: _Sequence[float] | _NDArray[_Any]
    def __init__(self, pose: GeoPose | None = ..., covariance: _Sequence[float] | _NDArray[_Any] | None = ...) -> None: ...
class GeoPoseWithCovarianceStamped(_Message):
    header: _std_msgs.Header
    pose: GeoPoseWithCovariance
    def __init__(self, header: _std_msgs.Header | None = ..., pose: GeoPoseWithCovariance | None = ...) -> None: ...
class GeographicMap(_Message):
    header: _std_msgs.Header
    id: _uuid_msgs.UniqueID
    bounds: BoundingBox
    points: list[WayPoint]
    features: list[MapFeature]
    props: list[KeyValue]
    def __init__(self, header: _std_msgs.Header | None = ..., id: _uuid_msgs.UniqueID | None = ..., bounds: BoundingBox | None = ..., points: list[WayPoint] | None = ..., features: list[MapFeature] | None = ..., props: list[KeyValue] | None = ...) -> None: ...
class GeographicMapChanges(_Message):
    header: _std_msgs.Header
    diffs: GeographicMap
    deletes: list[_uuid_msgs.UniqueID]
    def __init__(self, header: _std_msgs.Header | None = ..., diffs: GeographicMap | None = ..., deletes: list[_uuid_msgs.UniqueID] | None = ...) -> None: ...
class KeyValue(_Message):
    key: str
    value: str
    def __init__(self, key: str | None = ..., value: str | None = ...) -> None: ...
class MapFeature(_Message):
    id: _uuid_msgs.UniqueID
    components: list[_uuid_msgs.UniqueID]
    props: list[KeyValue]
    def __init__(self, id: _uuid_msgs.UniqueID | None = ..., components: list[_uuid_msgs.UniqueID] | None = ..., props: list[KeyValue] | None = ...) -> None: ...
class RouteNetwork(_Message):
    header: _std_msgs.Header
    id: _uuid_msgs.UniqueID
    bounds: BoundingBox
    points: list[WayPoint]
    segments: list[RouteSegment]
    props: list[KeyValue]
    def __init__(self, header: _std_msgs.Header | None = ..., id: _uuid_msgs.UniqueID | None = ..., bounds: BoundingBox | None = ..., points: list[WayPoint] | None = ..., segments: list[RouteSegment] | None = ..., props: list[KeyValue] | None = ...) -> None: ...
class RoutePath(_Message):
    header: _std_msgs.Header
    network: _uuid_msgs.UniqueID
    segments: list[_uuid_msgs.UniqueID]
    props: list[KeyValue]
    def __init__(self, header: _std_msgs.Header | None = ..., network: _uuid_msgs.UniqueID | None = ..., segments: list[_uuid_msgs.UniqueID] | None = ..., props: list[KeyValue] | None = ...) -> None: ...
class RouteSegment(_Message):
    id: _uuid_msgs.UniqueID
    start: _uuid_msgs.UniqueID
    end: _uuid_msgs.UniqueID
    props: list[KeyValue]
    def __init__(self, id: _uuid_msgs.UniqueID | None = ..., start: _uuid_msgs.UniqueID | None = ..., end: _uuid_msgs.UniqueID | None = ..., props: list[KeyValue] | None = ...) -> None: ...
class WayPoint(_Message):
    id: _uuid_msgs.UniqueID
    position: GeoPoint
    props: list[KeyValue]
    def __init__(self, id: _uuid_msgs.UniqueID | None = ..., position: GeoPoint | None = ..., props: list[KeyValue] | None = ...) -> None: ...
