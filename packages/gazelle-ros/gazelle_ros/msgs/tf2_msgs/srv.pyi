# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from typing import ClassVar as _ClassVar
from gazelle_ros.messages import Message as _Message
from gazelle_ros.messages import ServiceDefinition as _ServiceDefinition

class FrameGraphRequest(_Message):
    def __init__(self) -> None: ...
class FrameGraphResponse(_Message):
    frame_yaml: str
    def __init__(self, frame_yaml: str | None = ...) -> None: ...
class FrameGraph(_ServiceDefinition):
    _request_class: _ClassVar[type[FrameGraphRequest]]
    _response_class: _ClassVar[type[FrameGraphResponse]]
