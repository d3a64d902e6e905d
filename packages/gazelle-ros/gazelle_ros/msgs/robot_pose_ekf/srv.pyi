# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from typing import ClassVar as _ClassVar
from gazelle_ros.messages import Message as _Message
from gazelle_ros.messages import ServiceDefinition as _ServiceDefinition

class GetStatusRequest(_Message):
    def __init__(self) -> None: ...
class GetStatusResponse(_Message):
    status: str
    def __init__(self, status: str | None = ...) -> None: ...
class GetStatus(_ServiceDefinition):
    _request_class: _ClassVar[type[GetStatusRequest]]
    _response_class: _ClassVar[type[GetStatusResponse]]
