# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from collections.abc import Sequence as _Sequence
from typing import Any as _Any
from numpy.typing import NDArray as _NDArray
from gazelle_ros.messages import Message as _Message
from gazelle_ros.time import Duration as _Duration
from gazelle_ros.msgs.geometry_msgs import msg as _geometry_msgs
from gazelle_ros.msgs.std_msgs import msg as _std_msgs

class JointTrajectory(_Message):
    header: _std_msgs.Header
    joint_names: list[str]
    points: list[JointTrajectoryPoint]
    def __init__(self, header: _std_msgs.Header | None = ..., joint_names: list[str] | None = ..., points: list[JointTrajectoryPoint] | None = ...) -> None: ...
class JointTrajectoryPoint(_Message):
    positions: _Sequence[float] | _NDArray[_Any]
    velocities: _Sequence[float] | _NDArray[_Any]
    accelerations: _Sequence[float] | _NDArray[_Any]
    effort: _Sequence[float] | _NDArray[_Any]
    time_from_start: _Duration
    def __init__(self, positions: _Sequence[float] | _NDArray[_Any] | None = ..., velocities: _Sequence[float] | _NDArray[_Any] | None = ..., accelerations: _Sequence[float] | _NDArray[_Any] | None = ..., effort: _Sequence[float] | _NDArray[_Any] | None = ..., time_from_start: _Duration | None = ...) -> None: ...
class MultiDOFJointTrajectory(_Message):
    header: _std_msgs.Header
    joint_names: list[str]
    points: list[MultiDOFJointTrajectoryPoint]
    def __init__(self, header: _std_msgs.Header | None = ..., joint_names: list[str] | None = ..., points: list[MultiDOFJointTrajectoryPoint] | None = ...) -> None: ...
class MultiDOFJointTrajectoryPoint(_Message):
    transforms: list[_geometry_msgs.Transform]
    velocities: list[_geometry_msgs.Twist]
    accelerations: list[_geometry_msgs.Twist]
    time_from_start: _Duration
    def __init__(self, transforms: list[_geometry_msgs.Transform] | None = ..., velocities: list[_geometry_msgs.Twist] | None = ..., accelerations: list[_geometry_msgs.Twist] | None = ..., time_from_start: _Duration | None = ...) -> None: ...
