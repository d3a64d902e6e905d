# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from collections.abc import Sequence as _Sequence
from typing import Any as _Any
from typing import ClassVar as _ClassVar
from numpy.typing import NDArray as _NDArray
from gazelle_ros.messages import Message as _Message
from gazelle_ros.msgs.nav_msgs import msg as _nav_msgs
from gazelle_ros.msgs.sensor_msgs import msg as _sensor_msgs
from gazelle_ros.msgs.std_msgs import msg as _std_msgs

class OccupancyGridUpdate(_Message):
    header: _std_msgs.Header
    x: int
    y: int
    width: int
    height: int
    data: _Sequence[int] | _NDArray[_Any]
    def __init__(self, header: _std_msgs.Header | None = ..., x: int | None = ..., y: int | None = ..., width: int | None = ..., height: int | None = ..., data: _Sequence[int] | _NDArray[_Any] | None = ...) -> None: ...
class PointCloud2Update(_Message):
    ADD: _ClassVar[int]
    DELETE: _ClassVar[int]
    header: _std_msgs.Header
    type: int
    points: _sensor_msgs.PointCloud2
    def __init__(self, header: _std_msgs.Header | None = ..., type: int | None = ..., points: _sensor_msgs.PointCloud2 | None = ...) -> None: ...
class ProjectedMap(_Message):
    map: _nav_msgs.OccupancyGrid
    min_z: float
    max_z: float
    def __init__(self, map: _nav_msgs.OccupancyGrid | None = ..., min_z: float | None = ..., max_z: float | None = ...) -> None: ...
class ProjectedMapInfo(_Message):
    frame_id: str
    x: float
    y: float
    width: float
    height: float
    min_z: float
    max_z: float
    def __init__(self, frame_id: str | None = ..., x: float | None = ..., y: float | None = ..., width: float | None = ..., height: float | None = ..., min_z: float | None = ..., max_z: float | None = ...) -> None: ...
