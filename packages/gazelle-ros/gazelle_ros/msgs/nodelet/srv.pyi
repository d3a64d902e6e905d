# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from typing import ClassVar as _ClassVar
from gazelle_ros.messages import Message as _Message
from gazelle_ros.messages import ServiceDefinition as _ServiceDefinition

class NodeletListRequest(_Message):
    def __init__(self) -> None: ...
class NodeletListResponse(_Message):
    nodelets: list[str]
    def __init__(self, nodelets: list[str] | None = ...) -> None: ...
class NodeletList(_ServiceDefinition):
    _request_class: _ClassVar[type[NodeletListRequest]]
    _response_class: _ClassVar[type[NodeletListResponse]]
class NodeletLoadRequest(_Message):
    name: str
    type: str
    remap_source_args: list[str]
    remap_target_args: list[str]
    my_argv: list[str]
    bond_id: str
    def __init__(self, name: str | None = ..., type: str | None = ..., remap_source_args: list[str] | None = ..., remap_target_args: list[str] | None = ..., my_argv: list[str] | None = ..., bond_id: str | None = ...) -> None: ...
class NodeletLoadResponse(_Message):
    success: bool
    def __init__(self, success: bool | None = ...) -> None: ...
class NodeletLoad(_ServiceDefinition):
    _request_class: _ClassVar[type[NodeletLoadRequest]]
    _response_class: _ClassVar[type[NodeletLoadResponse]]
class NodeletUnloadRequest(_Message):
    name: str
    def __init__(self, name: str | None = ...) -> None: ...
class NodeletUnloadResponse(_Message):
    success: bool
    def __init__(self, success: bool | None = ...) -> None: ...
class NodeletUnload(_ServiceDefinition):
    _request_class: _ClassVar[type[NodeletUnloadRequest]]
    _response_class: _ClassVar[type[NodeletUnloadResponse]]
