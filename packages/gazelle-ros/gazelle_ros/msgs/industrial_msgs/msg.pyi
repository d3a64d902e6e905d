# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from typing import ClassVar as _ClassVar
from gazelle_ros.messages import Message as _Message
from gazelle_ros.msgs.std_msgs import msg as _std_msgs

class DebugLevel(_Message):
    DEBUG: _ClassVar[int]
    INFO: _ClassVar[int]
    WARN: _ClassVar[int]
    ERROR: _ClassVar[int]
    FATAL: _ClassVar[int]
    NONE: _ClassVar[int]
    val: int
    def __init__(self, val: int | None = ...) -> None: ...
class DeviceInfo(_Message):
    model: str
    serial_number: str
    hw_version: str
    sw_version: str
    address: str
    def __init__(self, model: str | None = ..., serial_number: str | None = ..., hw_version: str | None = ..., sw_version: str | None = ..., address: str | None = ...) -> None: ...
class RobotMode(_Message):
    UNKNOWN: _ClassVar[int]
    MANUAL: _ClassVar[int]
    AUTO: _ClassVar[int]
    val: int
    def __init__(self, val: int | None = ...) -> None: ...
class RobotStatus(_Message):
    header: _std_msgs.Header
    mode: RobotMode
    e_stopped: TriState
    drives_powered: TriState
    motion_possible: TriState
    in_motion: TriState
    in_error: TriState
    error_code: int
    def __init__(self, header: _std_msgs.Header | None = ..., mode: RobotMode | None = ..., e_stopped: TriState | None = ..., drives_powered: TriState | None = ..., motion_possible: TriState | None = ..., in_motion: TriState | None = ..., in_error: TriState | None = ..., error_code: int | None = ...) -> None: ...
class ServiceReturnCode(_Message):
    SUCCESS: _ClassVar[int]
    FAILURE: _ClassVar[int]
    val: int
    def __init__(self, val: int | None = ...) -> None: ...
class TriState(_Message):
    UNKNOWN: _ClassVar[int]
    TRUE: _ClassVar[int]
    ON: _ClassVar[int]
    ENABLED: _ClassVar[int]
    HIGH: _ClassVar[int]
    CLOSED: _ClassVar[int]
    FALSE: _ClassVar[int]
    OFF: _ClassVar[int]
    DISABLED: _ClassVar[int]
    LOW: _ClassVar[int]
    OPEN: _ClassVar[int]
    val: int
    def __init__(self, val: int | None = ...) -> None: ...
