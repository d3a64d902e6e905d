# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from collections.abc import Sequence as _Sequence
from typing import Any as _Any
from numpy.typing import NDArray as _NDArray
from gazelle_ros.messages import Message as _Message
from gazelle_ros.msgs.geometry_msgs import msg as _geometry_msgs
from gazelle_ros.msgs.std_msgs import msg as _std_msgs

class Octomap(_Message):
    header: _std_msgs.Header
    binary: bool
    id: str
    resolution: float
    data: _Sequence[int] | _NDArray[_Any]
    def __init__(self, header: _std_msgs.Header | None = ..., binary: bool | None = ..., id: str | None = ..., resolution: float | None = ..., data: _Sequence[int] | _NDArray[_Any] | None = ...) -> None: ...
class OctomapWithPose(_Message):
    header: _std_msgs.Header
    origin: _geometry_msgs.Pose
    octomap: Octomap
    def __init__(self, header: _std_msgs.Header | None = ..., origin: _geometry_msgs.Pose | None = ..., octomap: Octomap | None = ...) -> None: ...
