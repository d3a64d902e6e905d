# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from typing import ClassVar as _ClassVar
from gazelle_ros.messages import Message as _Message
from gazelle_ros.msgs.std_msgs import msg as _std_msgs

class SensorState(_Message):
    BUMPER_FORWARD: _ClassVar[int]
    BUMPER_BACKWARD: _ClassVar[int]
    CLIFF: _ClassVar[int]
    SONAR: _ClassVar[int]
    ILLUMINATION: _ClassVar[int]
    BUTTON0: _ClassVar[int]
    BUTTON1: _ClassVar[int]
    ERROR_LEFT_MOTOR: _ClassVar[int]
    ERROR_RIGHT_MOTOR: _ClassVar[int]
    TORQUE_ON: _ClassVar[int]
    TORQUE_OFF: _ClassVar[int]
    header: _std_msgs.Header
    bumper: int
    cliff: float
    sonar: float
    illumination: float
    led: int
    button: int
    torque: bool
    left_encoder: int
    right_encoder: int
    battery: float
    def __init__(self, header: _std_msgs.Header | None = ..., bumper: int | None = ..., cliff: float | None = ..., sonar: float | None = ..., illumination: float | None = ..., led: int | None = ..., button: int | None = ..., torque: bool | None = ..., left_encoder: int | None = ..., right_encoder: int | None = ..., battery: float | None = ...) -> None: ...
class Sound(_Message):
    OFF: _ClassVar[int]
    ON: _ClassVar[int]
    LOW_BATTERY: _ClassVar[int]
    ERROR: _ClassVar[int]
    BUTTON1: _ClassVar[int]
    BUTTON2: _ClassVar[int]
    value: int
    def __init__(self, value: int | None = ...) -> None: ...
class VersionInfo(_Message):
    hardware: str
    firmware: str
    software: str
    def __init__(self, hardware: str | None = ..., firmware: str | None = ..., software: str | None = ...) -> None: ...
