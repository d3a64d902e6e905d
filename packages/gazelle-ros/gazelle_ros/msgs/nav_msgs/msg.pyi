# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from collections.abc import Sequence as _Sequence
from typing import Any as _Any
from numpy.typing import NDArray as _NDArray
from gazelle_ros.messages import Message as _Message
from gazelle_ros.time import Time as _Time
from gazelle_ros.msgs.actionlib_msgs import msg as _actionlib_msgs
from gazelle_ros.msgs.geometry_msgs import msg as _geometry_msgs
from gazelle_ros.msgs.std_msgs import msg as _std_msgs

class GetMapAction(_Message):
    action_goal: GetMapActionGoal
    action_result: GetMapActionResult
    action_feedback: GetMapActionFeedback
    def __init__(self, action_goal: GetMapActionGoal | None = ..., action_result: GetMapActionResult | None = ..., action_feedback: GetMapActionFeedback | None = ...) -> None: ...
class GetMapActionFeedback(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    feedback: GetMapFeedback
    def __init__(self, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., feedback: GetMapFeedback | None = ...) -> None: ...
class GetMapActionGoal(_Message):
    header: _std_msgs.Header
    goal_id: _actionlib_msgs.GoalID
    goal: GetMapGoal
    def __init__(self, header: _std_msgs.Header | None = ..., goal_id: _actionlib_msgs.GoalID | None = ..., goal: GetMapGoal | None = ...) -> None: ...
class GetMapActionResult(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    result: GetMapResult
    def __init__(self, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., result: GetMapResult | None = ...) -> None: ...
class GetMapFeedback(_Message):
    def __init__(self) -> None: ...
class GetMapGoal(_Message):
    def __init__(self) -> None: ...
class GetMapResult(_Message):
    map: OccupancyGrid
    def __init__(self, map: OccupancyGrid | None = ...) -> None: ...
class GridCells(_Message):
    header: _std_msgs.Header
    cell_width: float
    cell_height: float
    cells: list[_geometry_msgs.Point]
    def __init__(self, header: _std_msgs.Header | None = ..., cell_width: float | None = ..., cell_height: float | None = ..., cells: list[_geometry_msgs.Point] | None = ...) -> None: ...
class MapMetaData(_Message):
    map_load_time: _Time
    resolution: float
    width: int
    height: int
    origin: _geometry_msgs.Pose
    def __init__(self, map_load_time: _Time | None = ..., resolution: float | None = ..., width: int | None = ..., height: int | None = ..., origin: _geometry_msgs.Pose | None = ...) -> None: ...
class OccupancyGrid(_Message):
    header: _std_msgs.Header
    info: MapMetaData
    data: _Sequence[int] | _NDArray[_Any]
    def __init__(self, header: _std_msgs.Header | None = ..., info: MapMetaData | None = ..., data: _Sequence[int] | _NDArray[_Any] | None = ...) -> None: ...
class Odometry(_Message):
    header: _std_msgs.Header
    child_frame_id: str
    pose: _geometry_msgs.PoseWithCovariance
    twist: _geometry_msgs.TwistWithCovariance
    def __init__(self, header: _std_msgs.Header | None = ..., child_frame_id: str | None = ..., pose: _geometry_msgs.PoseWithCovariance | None = ..., twist: _geometry_msgs.TwistWithCovariance | None = ...) -> None: ...
class Path(_Message):
    header: _std_msgs.Header
    poses: list[_geometry_msgs.PoseStamped]
    def __init__(self, header: _std_msgs.Header | None = ..., poses: list[_geometry_msgs.PoseStamped] | None = ...) -> None: ...
