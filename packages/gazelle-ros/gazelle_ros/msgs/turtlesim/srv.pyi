# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from typing import ClassVar as _ClassVar
from gazelle_ros.messages import Message as _Message
from gazelle_ros.messages import ServiceDefinition as _ServiceDefinition

class KillRequest(_Message):
    name: str
    def __init__(self, name: str | None = ...) -> None: ...
class KillResponse(_Message):
    def __init__(self) -> None: ...
class Kill(_ServiceDefinition):
    _request_class: _ClassVar[type[KillRequest]]
    _response_class: _ClassVar[type[KillResponse]]
class SetPenRequest(_Message):
    r: int
    g: int
    b: int
    width: int
    off: int
    def __init__(self, r: int | None = ..., g: int | None = ..., b: int | None = ..., width: int | None = ..., off: int | None = ...) -> None: ...
class SetPenResponse(_Message):
    def __init__(self) -> None: ...
class SetPen(_ServiceDefinition):
    _request_class: _ClassVar[type[SetPenRequest]]
    _response_class: _ClassVar[type[SetPenResponse]]
class SpawnRequest(_Message):
    x: float
    y: float
    theta: float
    name: str
    def __init__(self, x: float | None = ..., y: float | None = ..., theta: float | None = ..., name: str | None = ...) -> None: ...
class SpawnResponse(_Message):
    name: str
    def __init__(self, name: str | None = ...) -> None: ...
class Spawn(_ServiceDefinition):
    _request_class: _ClassVar[type[SpawnRequest]]
    _response_class: _ClassVar[type[SpawnResponse]]
class TeleportAbsoluteRequest(_Message):
    x: float
    y: float
    theta: float
    def __init__(self, x: float | None = ..., y: float | None = ..., theta: float | None = ...) -> None: ...
class TeleportAbsoluteResponse(_Message):
    def __init__(self) -> None: ...
class TeleportAbsolute(_ServiceDefinition):
    _request_class: _ClassVar[type[TeleportAbsoluteRequest]]
    _response_class: _ClassVar[type[TeleportAbsoluteResponse]]
class TeleportRelativeRequest(_Message):
    linear: float
    angular: float
    def __init__(self, linear: float | None = ..., angular: float | None = ...) -> None: ...
class TeleportRelativeResponse(_Message):
    def __init__(self) -> None: ...
class TeleportRelative(_ServiceDefinition):
    _request_class: _ClassVar[type[TeleportRelativeRequest]]
    _response_class: _ClassVar[type[TeleportRelativeResponse]]
