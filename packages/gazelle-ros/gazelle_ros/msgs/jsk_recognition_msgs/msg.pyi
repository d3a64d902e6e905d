# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from gazelle_ros.messages import Message as _Message
from gazelle_ros.msgs.geometry_msgs import msg as _geometry_msgs
from gazelle_ros.msgs.std_msgs import msg as _std_msgs

class BoundingBox(_Message):
    header: _std_msgs.Header
    pose: _geometry_msgs.Pose
    dimensions: _geometry_msgs.Vector3
    value: float
    label: int
    def __init__(self, header: _std_msgs.Header | None = ..., pose: _geometry_msgs.Pose | None = ..., dimensions: _geometry_msgs.Vector3 | None = ..., value: float | None = ..., label: int | None = ...) -> None: ...
class BoundingBoxArray(_Message):
    header: _std_msgs.Header
    boxes: list[BoundingBox]
    def __init__(self, header: _std_msgs.Header | None = ..., boxes: list[BoundingBox] | None = ...) -> None: ...
class Rect(_Message):
    x: int
    y: int
    width: int
    height: int
    def __init__(self, x: int | None = ..., y: int | None = ..., width: int | None = ..., height: int | None = ...) -> None: ...
class RectArray(_Message):
    header: _std_msgs.Header
    rects: list[Rect]
    def __init__(self, header: _std_msgs.Header | None = ..., rects: list[Rect] | None = ...) -> None: ...
