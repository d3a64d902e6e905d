# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from collections.abc import Sequence as _Sequence
from typing import Any as _Any
from typing import ClassVar as _ClassVar
from numpy.typing import NDArray as _NDArray
from gazelle_ros.messages import Message as _Message
from gazelle_ros.msgs.geometry_msgs import msg as _geometry_msgs

class JointPosition(_Message):
    joint_name: list[str]
    position: _Sequence[float] | _NDArray[_Any]
    max_accelerations_scaling_factor: float
    max_velocity_scaling_factor: float
    def __init__(self, joint_name: list[str] | None = ..., position: _Sequence[float] | _NDArray[_Any] | None = ..., max_accelerations_scaling_factor: float | None = ..., max_velocity_scaling_factor: float | None = ...) -> None: ...
class KinematicsPose(_Message):
    pose: _geometry_msgs.Pose
    max_accelerations_scaling_factor: float
    max_velocity_scaling_factor: float
    tolerance: float
    def __init__(self, pose: _geometry_msgs.Pose | None = ..., max_accelerations_scaling_factor: float | None = ..., max_velocity_scaling_factor: float | None = ..., tolerance: float | None = ...) -> None: ...
class OpenManipulatorState(_Message):
    IS_MOVING: _ClassVar[str]
    STOPPED: _ClassVar[str]
    ACTUATOR_ENABLED: _ClassVar[str]
    ACTUATOR_DISABLED: _ClassVar[str]
    open_manipulator_moving_state: str
    open_manipulator_actuator_state: str
    def __init__(self, open_manipulator_moving_state: str | None = ..., open_manipulator_actuator_state: str | None = ...) -> None: ...
