# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from collections.abc import Sequence as _Sequence
from typing import Any as _Any
from typing import ClassVar as _ClassVar
from numpy.typing import NDArray as _NDArray
from gazelle_ros.messages import Message as _Message
from gazelle_ros.msgs.geometry_msgs import msg as _geometry_msgs

class Mesh(_Message):
    triangles: list[MeshTriangle]
    vertices: list[_geometry_msgs.Point]
    def __init__(self, triangles: list[MeshTriangle] | None = ..., vertices: list[_geometry_msgs.Point] | None = ...) -> None: ...
class MeshTriangle(_Message):
    vertex_indices: _Sequence[int] | _NDArray[_Any]
    def __init__(self, vertex_indices: _Sequence[int] | _NDArray[_Any] | None = ...) -> None: ...
class Plane(_Message):
    coef: _Sequence[float] | _NDArray[_Any]
    def __init__(self, coef: _Sequence[float] | _NDArray[_Any] | None = ...) -> None: ...
class SolidPrimitive(_Message):
    BOX: _ClassVar[int]
    SPHERE: _ClassVar[int]
    CYLINDER: _ClassVar[int]
    CONE: _ClassVar[int]
    BOX_X: _ClassVar[int]
    BOX_Y: _ClassVar[int]
    BOX_Z: _ClassVar[int]
    SPHERE_RADIUS: _ClassVar[int]
    CYLINDER_HEIGHT: _ClassVar[int]
    CYLINDER_RADIUS: _ClassVar[int]
    CONE_HEIGHT: _ClassVar[int]
    CONE_RADIUS: _ClassVar[int]
    type: int
    dimensions: _Sequence[float] | _NDArray[_Any]
    def __init__(self, type: int | None = ..., dimensions: _Sequence[float] | _NDArray[_Any] | None = ...) -> None: ...
