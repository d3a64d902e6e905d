# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from typing import ClassVar as _ClassVar
from gazelle_ros.messages import Message as _Message
from gazelle_ros.messages import ServiceDefinition as _ServiceDefinition
from gazelle_ros.msgs.diagnostic_msgs import msg as _diagnostic_msgs

class AddDiagnosticsRequest(_Message):
    load_namespace: str
    def __init__(self, load_namespace: str | None = ...) -> None: ...
class AddDiagnosticsResponse(_Message):
    success: bool
    message: str
    def __init__(self, success: bool | None = ..., message: str | None = ...) -> None: ...
class AddDiagnostics(_ServiceDefinition):
    _request_class: _ClassVar[type[AddDiagnosticsRequest]]
    _response_class: _ClassVar[type[AddDiagnosticsResponse]]
class SelfTestRequest(_Message):
    def __init__(self) -> None: ...
class SelfTestResponse(_Message):
    id: str
    passed: int
    status: list[_diagnostic_msgs.DiagnosticStatus]
    def __init__(self, id: str | None = ..., passed: int | None = ..., status: list[_diagnostic_msgs.DiagnosticStatus] | None = ...) -> None: ...
class SelfTest(_ServiceDefinition):
    _request_class: _ClassVar[type[SelfTestRequest]]
    _response_class: _ClassVar[type[SelfTestResponse]]
