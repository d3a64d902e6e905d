# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from typing import ClassVar as _ClassVar
from gazelle_ros.messages import Message as _Message
from gazelle_ros.messages import ServiceDefinition as _ServiceDefinition

class SetPidGainsRequest(_Message):
    p: float
    i: float
    d: float
    i_clamp: float
    antiwindup: bool
    def __init__(self, p: float | None = ..., i: float | None = ..., d: float | None = ..., i_clamp: float | None = ..., antiwindup: bool | None = ...) -> None: ...
class SetPidGainsResponse(_Message):
    def __init__(self) -> None: ...
class SetPidGains(_ServiceDefinition):
    _request_class: _ClassVar[type[SetPidGainsRequest]]
    _response_class: _ClassVar[type[SetPidGainsResponse]]
