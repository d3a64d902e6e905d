# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from typing import ClassVar as _ClassVar
from gazelle_ros.messages import Message as _Message
from gazelle_ros.messages import ServiceDefinition as _ServiceDefinition

class AttachRequest(_Message):
    model_name_1: str
    link_name_1: str
    model_name_2: str
    link_name_2: str
    def __init__(self, model_name_1: str | None = ..., link_name_1: str | None = ..., model_name_2: str | None = ..., link_name_2: str | None = ...) -> None: ...
class AttachResponse(_Message):
    ok: bool
    def __init__(self, ok: bool | None = ...) -> None: ...
class Attach(_ServiceDefinition):
    _request_class: _ClassVar[type[AttachRequest]]
    _response_class: _ClassVar[type[AttachResponse]]
class SetStaticRequest(_Message):
    model_name: str
    link_name: str
    set_static: bool
    def __init__(self, model_name: str | None = ..., link_name: str | None = ..., set_static: bool | None = ...) -> None: ...
class SetStaticResponse(_Message):
    ok: bool
    def __init__(self, ok: bool | None = ...) -> None: ...
class SetStatic(_ServiceDefinition):
    _request_class: _ClassVar[type[SetStaticRequest]]
    _response_class: _ClassVar[type[SetStaticResponse]]
