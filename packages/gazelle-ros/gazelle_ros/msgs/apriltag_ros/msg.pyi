# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from collections.abc import Sequence as _Sequence
from typing import Any as _Any
from numpy.typing import NDArray as _NDArray
from gazelle_ros.messages import Message as _Message
from gazelle_ros.msgs.geometry_msgs import msg as _geometry_msgs
from gazelle_ros.msgs.std_msgs import msg as _std_msgs

class AprilTagDetection(_Message):
    id: _Sequence[int] | _NDArray[_Any]
    size: _Sequence[float] | _NDArray[_Any]
    pose: _geometry_msgs.PoseWithCovarianceStamped
    def __init__(self, id: _Sequence[int] | _NDArray[_Any] | None = ..., size: _Sequence[float] | _NDArray[_Any] | None = ..., pose: _geometry_msgs.PoseWithCovarianceStamped | None = ...) -> None: ...
class AprilTagDetectionArray(_Message):
    header: _std_msgs.Header
    detections: list[AprilTagDetection]
    def __init__(self, header: _std_msgs.Header | None = ..., detections: list[AprilTagDetection] | None = ...) -> None: ...
