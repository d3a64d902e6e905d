# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from typing import ClassVar as _ClassVar
from gazelle_ros.messages import Message as _Message
from gazelle_ros.messages import ServiceDefinition as _ServiceDefinition

class UpdateFilenameRequest(_Message):
    filename: str
    def __init__(self, filename: str | None = ...) -> None: ...
class UpdateFilenameResponse(_Message):
    success: bool
    def __init__(self, success: bool | None = ...) -> None: ...
class UpdateFilename(_ServiceDefinition):
    _request_class: _ClassVar[type[UpdateFilenameRequest]]
    _response_class: _ClassVar[type[UpdateFilenameResponse]]
