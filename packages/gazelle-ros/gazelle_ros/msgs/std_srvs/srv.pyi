# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from typing import ClassVar as _ClassVar
from gazelle_ros.messages import Message as _Message
from gazelle_ros.messages import ServiceDefinition as _ServiceDefinition

class EmptyRequest(_Message):
    def __init__(self) -> None: ...
class EmptyResponse(_Message):
    def __init__(self) -> None: ...
class Empty(_ServiceDefinition):
    _request_class: _ClassVar[type[EmptyRequest]]
    _response_class: _ClassVar[type[EmptyResponse]]
class SetBoolRequest(_Message):
    data: bool
    def __init__(self, data: bool | None = ...) -> None: ...
class SetBoolResponse(_Message):
    success: bool
    message: str
    def __init__(self, success: bool | None = ..., message: str | None = ...) -> None: ...
class SetBool(_ServiceDefinition):
    _request_class: _ClassVar[type[SetBoolRequest]]
    _response_class: _ClassVar[type[SetBoolResponse]]
class TriggerRequest(_Message):
    def __init__(self) -> None: ...
class TriggerResponse(_Message):
    success: bool
    message: str
    def __init__(self, success: bool | None = ..., message: str | None = ...) -> None: ...
class Trigger(_ServiceDefinition):
    _request_class: _ClassVar[type[TriggerRequest]]
    _response_class: _ClassVar[type[TriggerResponse]]
