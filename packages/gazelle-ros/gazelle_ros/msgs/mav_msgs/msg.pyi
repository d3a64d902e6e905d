# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from collections.abc import Sequence as _Sequence
from typing import Any as _Any
from numpy.typing import NDArray as _NDArray
from gazelle_ros.messages import Message as _Message
from gazelle_ros.msgs.geometry_msgs import msg as _geometry_msgs
from gazelle_ros.msgs.std_msgs import msg as _std_msgs

class Actuators(_Message):
    header: _std_msgs.Header
    angles: _Sequence[float] | _NDArray[_Any]
    angular_velocities: _Sequence[float] | _NDArray[_Any]
    normalized: _Sequence[float] | _NDArray[_Any]
    def __init__(self, header: _std_msgs.Header | None = ..., angles: _Sequence[float] | _NDArray[_Any] | None = ..., angular_velocities: _Sequence[float] | _NDArray[_Any] | None = ..., normalized: _Sequence[float] | _NDArray[_Any] | None = ...) -> None: ...
class AttitudeThrust(_Message):
    header: _std_msgs.Header
    attitude: _geometry_msgs.Quaternion
    thrust: _geometry_msgs.Vector3
    def __init__(self, header: _std_msgs.Header | None = ..., attitude: _geometry_msgs.Quaternion | None = ..., thrust: _geometry_msgs.Vector3 | None = ...) -> None: ...
class RateThrust(_Message):
    header: _std_msgs.Header
    angular_rates: _geometry_msgs.Vector3
    thrust: _geometry_msgs.Vector3
    def __init__(self, header: _std_msgs.Header | None = ..., angular_rates: _geometry_msgs.Vector3 | None = ..., thrust: _geometry_msgs.Vector3 | None = ...) -> None: ...
class RollPitchYawrateThrust(_Message):
    header: _std_msgs.Header
    roll: float
    pitch: float
    yaw_rate: float
    thrust: _geometry_msgs.Vector3
    def __init__(self, header: _std_msgs.Header | None = ..., roll: float | None = ..., pitch: float | None = ..., yaw_rate: float | None = ..., thrust: _geometry_msgs.Vector3 | None = ...) -> None: ...
