# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from gazelle_ros.messages import Message as _Message
from gazelle_ros.time import Duration as _Duration
from gazelle_ros.msgs.costmap_converter import msg as _costmap_converter
from gazelle_ros.msgs.geometry_msgs import msg as _geometry_msgs
from gazelle_ros.msgs.std_msgs import msg as _std_msgs

class FeedbackMsg(_Message):
    header: _std_msgs.Header
    trajectories: list[TrajectoryMsg]
    selected_trajectory_idx: int
    obstacles_msg: _costmap_converter.ObstacleArrayMsg
    def __init__(self, header: _std_msgs.Header | None = ..., trajectories: list[TrajectoryMsg] | None = ..., selected_trajectory_idx: int | None = ..., obstacles_msg: _costmap_converter.ObstacleArrayMsg | None = ...) -> None: ...
class TrajectoryMsg(_Message):
    header: _std_msgs.Header
    trajectory: list[TrajectoryPointMsg]
    def __init__(self, header: _std_msgs.Header | None = ..., trajectory: list[TrajectoryPointMsg] | None = ...) -> None: ...
class TrajectoryPointMsg(_Message):
    pose: _geometry_msgs.Pose
    velocity: _geometry_msgs.Twist
    acceleration: _geometry_msgs.Twist
    time_from_start: _Duration
    def __init__(self, pose: _geometry_msgs.Pose | None = ..., velocity: _geometry_msgs.Twist | None = ..., acceleration: _geometry_msgs.Twist | None = ..., time_from_start: _Duration | None = ...) -> None: ...
