# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from collections.abc import Sequence as _Sequence
from typing import Any as _Any
from numpy.typing import NDArray as _NDArray
from gazelle_ros.messages import Message as _Message
from gazelle_ros.msgs.sensor_msgs import msg as _sensor_msgs
from gazelle_ros.msgs.std_msgs import msg as _std_msgs

class ModelCoefficients(_Message):
    header: _std_msgs.Header
    values: _Sequence[float] | _NDArray[_Any]
    def __init__(self, header: _std_msgs.Header | None = ..., values: _Sequence[float] | _NDArray[_Any] | None = ...) -> None: ...
class PointIndices(_Message):
    header: _std_msgs.Header
    indices: _Sequence[int] | _NDArray[_Any]
    def __init__(self, header: _std_msgs.Header | None = ..., indices: _Sequence[int] | _NDArray[_Any] | None = ...) -> None: ...
class PolygonMesh(_Message):
    header: _std_msgs.Header
    cloud: _sensor_msgs.PointCloud2
    polygons: list[Vertices]
    def __init__(self, header: _std_msgs.Header | None = ..., cloud: _sensor_msgs.PointCloud2 | None = ..., polygons: list[Vertices] | None = ...) -> None: ...
class Vertices(_Message):
    vertices: _Sequence[int] | _NDArray[_Any]
    def __init__(self, vertices: _Sequence[int] | _NDArray[_Any] | None = ...) -> None: ...
