# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from collections.abc import Sequence as _Sequence
from typing import Any as _Any
from numpy.typing import NDArray as _NDArray
from gazelle_ros.messages import Message as _Message
from gazelle_ros.msgs.geometry_msgs import msg as _geometry_msgs
from gazelle_ros.msgs.std_msgs import msg as _std_msgs

class VoxelGrid(_Message):
    header: _std_msgs.Header
    data: _Sequence[int] | _NDArray[_Any]
    origin: _geometry_msgs.Point32
    resolutions: _geometry_msgs.Vector3
    size_x: int
    size_y: int
    size_z: int
    def __init__(self, header: _std_msgs.Header | None = ..., data: _Sequence[int] | _NDArray[_Any] | None = ..., origin: _geometry_msgs.Point32 | None = ..., resolutions: _geometry_msgs.Vector3 | None = ..., size_x: int | None = ..., size_y: int | None = ..., size_z: int | None = ...) -> None: ...
