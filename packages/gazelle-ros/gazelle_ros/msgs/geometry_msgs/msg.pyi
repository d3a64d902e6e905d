# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from collections.abc import Sequence as _Sequence
from typing import Any as _Any
from numpy.typing import NDArray as _NDArray
from gazelle_ros.messages import Message as _Message
from gazelle_ros.msgs.std_msgs import msg as _std_msgs

class Accel(_Message):
    linear: Vector3
    angular: Vector3
    def __init__(self, linear: Vector3 | None = ..., angular: Vector3 | None = ...) -> None: ...
class AccelStamped(_Message):
    header: _std_msgs.Header
    accel: Accel
    def __init__(self, header: _std_msgs.Header | None = ..., accel: Accel | None = ...) -> None: ...
class AccelWithCovariance(_Message):
    accel: Accel
    covariance: _Sequence[float] | _NDArray[_Any]
    def __init__(self, accel: Accel | None = ..., covariance: _Sequence[float] | _NDArray[_Any] | None = ...) -> None: ...
class AccelWithCovarianceStamped(_Message):
    header: _std_msgs.Header
    accel: AccelWithCovariance
    def __init__(self, header: _std_msgs.Header | None = ..., accel: AccelWithCovariance | None = ...) -> None: ...
class Inertia(_Message):
    m: float
    com: Vector3
    ixx: float
    ixy: float
    ixz: float
    iyy: float
    iyz: float
    izz: float
    def __init__(self, m: float | None = ..., com: Vector3 | None = ..., ixx: float | None = ..., ixy: float | None = ..., ixz: float | None = ..., iyy: float | None = ..., iyz: float | None = ..., izz: float | None = ...) -> None: ...
class InertiaStamped(_Message):
    header: _std_msgs.Header
    inertia: Inertia
    def __init__(self, header: _std_msgs.Header | None = ..., inertia: Inertia | None = ...) -> None: ...
class Point(_Message):
    x: float
    y: float
    z: float
    def __init__(self, x: float | None = ..., y: float | None = ..., z: float | None = ...) -> None: ...
class Point32(_Message):
    x: float
    y: float
    z: float
    def __init__(self, x: float | None = ..., y: float | None = ..., z: float | None = ...) -> None: ...
class PointStamped(_Message):
    header: _std_msgs.Header
    point: Point
    def __init__(self, header: _std_msgs.Header | None = ..., point: Point | None = ...) -> None: ...
class Polygon(_Message):
    points: list[Point32]
    def __init__(self, points: list[Point32] | None = ...) -> None: ...
class PolygonStamped(_Message):
    header: _std_msgs.Header
    polygon: Polygon
    def __init__(self, header: _std_msgs.Header | None = ..., polygon: Polygon | None = ...) -> None: ...
class Pose(_Message):
    position: Point
    orientation: Quaternion
    def __init__(self, position: Point | None = ..., orientation: Quaternion | None = ...) -> None: ...
class Pose2D(_Message):
    x: float
    y: float
    theta: float
    def __init__(self, x: float | None = ..., y: float | None = ..., theta: float | None = ...) -> None: ...
class PoseArray(_Message):
    header: _std_msgs.Header
    poses: list[Pose]
    def __init__(self, header: _std_msgs.Header | None = ..., poses: list[Pose] | None = ...) -> None: ...
class PoseStamped(_Message):
    header: _std_msgs.Header
    pose: Pose
    def __init__(self, header: _std_msgs.Header | None = ..., pose: Pose | None = ...) -> None: ...
class PoseWithCovariance(_Message):
    pose: Pose
    covariance: _Sequence[float] | _NDArray[_Any]
    def __init__(self, pose: Pose | None = ..., covariance: _Sequence[float] | _NDArray[_Any] | None = ...) -> None: ...
class PoseWithCovarianceStamped(_Message):
    header: _std_msgs.Header
    pose: PoseWithCovariance
    def __init__(self, header: _std_msgs.Header | None = ..., pose: PoseWithCovariance | None = ...) -> None: ...
class Quaternion(_Message):
    x: float
    y: float
    z: float
    w: float
    def __init__(self, x: float | None = ..., y: float | None = ..., z: float | None = ..., w: float | None = ...) -> None: ...
class QuaternionStamped(_Message):
    header: _std_msgs.Header
    quaternion: Quaternion
    def __init__(self, header: _std_msgs.Header | None = ..., quaternion: Quaternion | None = ...) -> None: ...
class Transform(_Message):
    translation: Vector3
    rotation: Quaternion
    def __init__(self, translation: Vector3 | None = ..., rotation: Quaternion | None = ...) -> None: ...
class TransformStamped(_Message):
    header: _std_msgs.Header
    child_frame_id: str
    transform: Transform
    def __init__(self, header: _std_msgs.Header | None = ..., child_frame_id: str | None = ..., transform: Transform | None = ...) -> None: ...
class Twist(_Message):
    linear: Vector3
    angular: Vector3
    def __init__(self, linear: Vector3 | None = ..., angular: Vector3 | None = ...) -> None: ...
class TwistStamped(_Message):
    header: _std_msgs.Header
    twist: Twist
    def __init__(self, header: _std_msgs.Header | None = ..., twist: Twist | None = ...) -> None: ...
class TwistWithCovariance(_Message):
    twist: Twist
    covariance: _Sequence[float] | _NDArray[_Any]
    def __init__(self, twist: Twist | None = ..., covariance: _Sequence[float] | _NDArray[_Any] | None = ...) -> None: ...
class TwistWithCovarianceStamped(_Message):
    header: _std_msgs.Header
    twist: TwistWithCovariance
    def __init__(self, header: _std_msgs.Header | None = ..., twist: TwistWithCovariance | None = ...) -> None: ...
class Vector3(_Message):
    x: float
    y: float
    z: float
    def __init__(self, x: float | None = ..., y: float | None = ..., z: float | None = ...) -> None: ...
class Vector3Stamped(_Message):
    header: _std_msgs.Header
    vector: Vector3
    def __init__(self, header: _std_msgs.Header | None = ..., vector: Vector3 | None = ...) -> None: ...
class Wrench(_Message):
    force: Vector3
    torque: Vector3
    def __init__(self, force: Vector3 | None = ..., torque: Vector3 | None = ...) -> None: ...
class WrenchStamped(_Message):
    header: _std_msgs.Header
    wrench: Wrench
    def __init__(self, header: _std_msgs.Header | None = ..., wrench: Wrench | None = ...) -> None: ...
