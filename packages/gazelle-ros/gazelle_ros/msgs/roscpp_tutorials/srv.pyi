# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from typing import ClassVar as _ClassVar
from gazelle_ros.messages import Message as _Message
from gazelle_ros.messages import ServiceDefinition as _ServiceDefinition

class TwoIntsRequest(_Message):
    a: int
    b: int
    def __init__(self, a: int | None = ..., b: int | None = ...) -> None: ...
class TwoIntsResponse(_Message):
    sum: int
    def __init__(self, sum: int | None = ...) -> None: ...
class TwoInts(_ServiceDefinition):
    _request_class: _ClassVar[type[TwoIntsRequest]]
    _response_class: _ClassVar[type[TwoIntsResponse]]
