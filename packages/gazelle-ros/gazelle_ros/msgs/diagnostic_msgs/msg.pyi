# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from typing import ClassVar as _ClassVar
from gazelle_ros.messages import Message as _Message
from gazelle_ros.msgs.std_msgs import msg as _std_msgs

class DiagnosticArray(_Message):
    header: _std_msgs.Header
    status: list[DiagnosticStatus]
    def __init__(self, header: _std_msgs.Header | None = ..., status: list[DiagnosticStatus] | None = ...) -> None: ...
class DiagnosticStatus(_Message):
    OK: _ClassVar[int]
    WARN: _ClassVar[int]
    ERROR: _ClassVar[int]
    STALE: _ClassVar[int]
    level: int
    name: str
    message: str
    hardware_id: str
    values: list[KeyValue]
    def __init__(self, level: int | None = ..., name: str | None = ..., message: str | None = ..., hardware_id: str | None = ..., values: list[KeyValue] | None = ...) -> None: ...
class KeyValue(_Message):
    key: str
    value: str
    def __init__(self, key: str | None = ..., value: str | None = ...) -> None: ...
