# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from typing import ClassVar as _ClassVar
from gazelle_ros.messages import Message as _Message
from gazelle_ros.messages import ServiceDefinition as _ServiceDefinition
from gazelle_ros.msgs.dynamic_reconfigure import msg as _dynamic_reconfigure

class ReconfigureRequest(_Message):
    config: _dynamic_reconfigure.Config
    def __init__(self, config: _dynamic_reconfigure.Config | None = ...) -> None: ...
class ReconfigureResponse(_Message):
    config: _dynamic_reconfigure.Config
    def __init__(self, config: _dynamic_reconfigure.Config | None = ...) -> None: ...
class Reconfigure(_ServiceDefinition):
    _request_class: _ClassVar[type[ReconfigureRequest]]
    _response_class: _ClassVar[type[ReconfigureResponse]]
