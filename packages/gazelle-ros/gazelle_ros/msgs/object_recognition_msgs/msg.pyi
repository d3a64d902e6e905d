# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from collections.abc import Sequence as _Sequence
from typing import Any as _Any
from numpy.typing import NDArray as _NDArray
from gazelle_ros.messages import Message as _Message
from gazelle_ros.msgs.actionlib_msgs import msg as _actionlib_msgs
from gazelle_ros.msgs.geometry_msgs import msg as _geometry_msgs
from gazelle_ros.msgs.sensor_msgs import msg as _sensor_msgs
from gazelle_ros.msgs.shape_msgs import msg as _shape_msgs
from gazelle_ros.msgs.std_msgs import msg as _std_msgs

class ObjectInformation(_Message):
    name: str
    ground_truth_mesh: _shape_msgs.Mesh
    ground_truth_point_cloud: _sensor_msgs.PointCloud2
    def __init__(self, name: str | None = ..., ground_truth_mesh: _shape_msgs.Mesh | None = ..., ground_truth_point_cloud: _sensor_msgs.PointCloud2 | None = ...) -> None: ...
class ObjectRecognitionAction(_Message):
    action_goal: ObjectRecognitionActionGoal
    action_result: ObjectRecognitionActionResult
    action_feedback: ObjectRecognitionActionFeedback
    def __init__(self, action_goal: ObjectRecognitionActionGoal | None = ..., action_result: ObjectRecognitionActionResult | None = ..., action_feedback: ObjectRecognitionActionFeedback | None = ...) -> None: ...
class ObjectRecognitionActionFeedback(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    feedback: ObjectRecognitionFeedback
    def __init__(self, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., feedback: ObjectRecognitionFeedback | None = ...) -> None: ...
class ObjectRecognitionActionGoal(_Message):
    header: _std_msgs.Header
    goal_id: _actionlib_msgs.GoalID
    goal: ObjectRecognitionGoal
    def __init__(self, header: _std_msgs.Header | None = ..., goal_id: _actionlib_msgs.GoalID | None = ..., goal: ObjectRecognitionGoal | None = ...) -> None: ...
class ObjectRecognitionActionResult(_Message):
    header: _std_msgs.Header
    status: _actionlib_msgs.GoalStatus
    result: ObjectRecognitionResult
    def __init__(self, header: _std_msgs.Header | None = ..., status: _actionlib_msgs.GoalStatus | None = ..., result: ObjectRecognitionResult | None = ...) -> None: ...
class ObjectRecognitionFeedback(_Message):
    def __init__(self) -> None: ...
class ObjectRecognitionGoal(_Message):
    use_roi: bool
    filter_limits: _Sequence[float] | _NDArray[_Any]
    def __init__(self, use_roi: bool | None = ..., filter_limits: _Sequence[float] | _NDArray[_Any] | None = ...) -> None: ...
class ObjectRecognitionResult(_Message):
    recognized_objects: RecognizedObjectArray
    def __init__(self, recognized_objects: RecognizedObjectArray | None = ...) -> None: ...
class ObjectType(_Message):
    key: str
    db: str
    def __init__(self, key: str | None = ..., db: str | None = ...) -> None: ...
class RecognizedObject(_Message):
    header: _std_msgs.Header
    type: ObjectType
    confidence: float
    point_clouds: list[_sensor_msgs.PointCloud2]
    bounding_mesh: _shape_msgs.Mesh
    bounding_contours: list[_geometry_msgs.Point]
    pose: _geometry_msgs.PoseWithCovarianceStamped
    def __init__(self, header: _std_msgs.Header | None = ..., type: ObjectType | None = ..., confidence: float | None = ..., point_clouds: list[_sensor_msgs.PointCloud2] | None = ..., bounding_mesh: _shape_msgs.Mesh | None = ..., bounding_contours: list[_geometry_msgs.Point] | None = ..., pose: _geometry_msgs.PoseWithCovarianceStamped | None = ...) -> None: ...
class RecognizedObjectArray(_Message):
    header: _std_msgs.Header
    objects: list[RecognizedObject]
    cooccurrence: _Sequence[float] | _NDArray[_Any]
    def __init__(self, header: _std_msgs.Header | None = ..., objects: list[RecognizedObject] | None = ..., cooccurrence: _Sequence[float] | _NDArray[_Any] | None = ...) -> None: ...
class Table(_Message):
    header: _std_msgs.Header
    pose: _geometry_msgs.Pose
    convex_hull: list[_geometry_msgs.Point]
    def __init__(self, header: _std_msgs.Header | None = ..., pose: _geometry_msgs.Pose | None = ..., convex_hull: list[_geometry_msgs.Point] | None = ...) -> None: ...
class TableArray(_Message):
    header: _std_msgs.Header
    tables: list[Table]
    def __init__(self, header: _std_msgs.Header | None = ..., tables: list[Table] | None = ...) -> None: ...
