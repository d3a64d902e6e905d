# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from gazelle_ros.messages import Message as _Message
from gazelle_ros.msgs.geometry_msgs import msg as _geometry_msgs
from gazelle_ros.msgs.sensor_msgs import msg as _sensor_msgs
from gazelle_ros.msgs.std_msgs import msg as _std_msgs

class BoundingBox2D(_Message):
    center: _geometry_msgs.Pose2D
    size_x: float
    size_y: float
    def __init__(self, center: _geometry_msgs.Pose2D | None = ..., size_x: float | None = ..., size_y: float | None = ...) -> None: ...
class BoundingBox2DArray(_Message):
    header: _std_msgs.Header
    boxes: list[BoundingBox2D]
    def __init__(self, header: _std_msgs.Header | None = ..., boxes: list[BoundingBox2D] | None = ...) -> None: ...
class BoundingBox3D(_Message):
    center: _geometry_msgs.Pose
    size: _geometry_msgs.Vector3
    def __init__(self, center: _geometry_msgs.Pose | None = ..., size: _geometry_msgs.Vector3 | None = ...) -> None: ...
class BoundingBox3DArray(_Message):
    header: _std_msgs.Header
    boxes: list[BoundingBox3D]
    def __init__(self, header: _std_msgs.Header | None = ..., boxes: list[BoundingBox3D] | None = ...) -> None: ...
class Classification2D(_Message):
    header: _std_msgs.Header
    results: list[ObjectHypothesis]
    source_img: _sensor_msgs.Image
    def __init__(self, header: _std_msgs.Header | None = ..., results: list[ObjectHypothesis] | None = ..., source_img: _sensor_msgs.Image | None = ...) -> None: ...
class Classification3D(_Message):
    header: _std_msgs.Header
    results: list[ObjectHypothesis]
    source_cloud: _sensor_msgs.PointCloud2
    def __init__(self, header: _std_msgs.Header | None = ..., results: list[ObjectHypothesis] | None = ..., source_cloud: _sensor_msgs.PointCloud2 | None = ...) -> None: ...
class Detection2D(_Message):
    header: _std_msgs.Header
    results: list[ObjectHypothesisWithPose]
    bbox: BoundingBox2D
    source_img: _sensor_msgs.Image
    def __init__(self, header: _std_msgs.Header | None = ..., results: list[ObjectHypothesisWithPose] | None = ..., bbox: BoundingBox2D | None = ..., source_img: _sensor_msgs.Image | None = ...) -> None: ...
class Detection2DArray(_Message):
    header: _std_msgs.Header
    detections: list[Detection2D]
    def __init__(self, header: _std_msgs.Header | None = ..., detections: list[Detection2D] | None = ...) -> None: ...
class Detection3D(_Message):
    header: _std_msgs.Header
    results: list[ObjectHypothesisWithPose]
    bbox: BoundingBox3D
    source_cloud: _sensor_msgs.PointCloud2
    def __init__(self, header: _std_msgs.Header | None = ..., results: list[ObjectHypothesisWithPose] | None = ..., bbox: BoundingBox3D | None = ..., source_cloud: _sensor_msgs.PointCloud2 | None = ...) -> None: ...
class Detection3DArray(_Message):
    header: _std_msgs.Header
    detections: list[Detection3D]
    def __init__(self, header: _std_msgs.Header | None = ..., detections: list[Detection3D] | None = ...) -> None: ...
class ObjectHypothesis(_Message):
    id: int
    score: float
    def __init__(self, id: int | None = ..., score: float | None = ...) -> None: ...
class ObjectHypothesisWithPose(_Message):
    id: int
    score: float
    pose: _geometry_msgs.PoseWithCovariance
    def __init__(self, id: int | None = ..., score: float | None = ..., pose: _geometry_msgs.PoseWithCovariance | None = ...) -> None: ...
class VisionInfo(_Message):
    header: _std_msgs.Header
    method: str
    database_location: str
    database_version: int
    def __init__(self, header: _std_msgs.Header | None = ..., method: str | None = ..., database_location: str | None = ..., database_version: int | None = ...) -> None: ...
