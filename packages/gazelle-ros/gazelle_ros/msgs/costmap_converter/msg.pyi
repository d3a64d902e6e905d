# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from gazelle_ros.messages import Message as _Message
from gazelle_ros.msgs.geometry_msgs import msg as _geometry_msgs
from gazelle_ros.msgs.std_msgs import msg as _std_msgs

class ObstacleArrayMsg(_Message):
    header: _std_msgs.Header
    obstacles: list[ObstacleMsg]
    def __init__(self, header: _std_msgs.Header | None = ..., obstacles: list[ObstacleMsg] | None = ...) -> None: ...
class ObstacleMsg(_Message):
    header: _std_msgs.Header
    polygon: _geometry_msgs.Polygon
    radius: float
    id: int
    orientation: _geometry_msgs.Quaternion
    velocities: _geometry_msgs.TwistWithCovariance
    def __init__(self, header: _std_msgs.Header | None = ..., polygon: _geometry_msgs.Polygon | None = ..., radius: float | None = ..., id: int | None = ..., orientation: _geometry_msgs.Quaternion | None = ..., velocities: _geometry_msgs.TwistWithCovariance | None = ...) -> None: ...
