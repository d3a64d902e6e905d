# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from typing import ClassVar as _ClassVar
from gazelle_ros.messages import Message as _Message
from gazelle_ros.messages import ServiceDefinition as _ServiceDefinition
from gazelle_ros.msgs.roscpp import msg as _roscpp

class EmptyRequest(_Message):
    def __init__(self) -> None: ...
class EmptyResponse(_Message):
    def __init__(self) -> None: ...
class Empty(_ServiceDefinition):
    _request_class: _ClassVar[type[EmptyRequest]]
    _response_class: _ClassVar[type[EmptyResponse]]
class GetLoggersRequest(_Message):
    def __init__(self) -> None: ...
class GetLoggersResponse(_Message):
    loggers: list[_roscpp.Logger]
    def __init__(self, loggers: list[_roscpp.Logger] | None = ...) -> None: ...
class GetLoggers(_ServiceDefinition):
    _request_class: _ClassVar[type[GetLoggersRequest]]
    _response_class: _ClassVar[type[GetLoggersResponse]]
class SetLoggerLevelRequest(_Message):
    logger: str
    level: str
    def __init__(self, logger: str | None = ..., level: str | None = ...) -> None: ...
class SetLoggerLevelResponse(_Message):
    def __init__(self) -> None: ...
class SetLoggerLevel(_ServiceDefinition):
    _request_class: _ClassVar[type[SetLoggerLevelRequest]]
    _response_class: _ClassVar[type[SetLoggerLevelResponse]]
