# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from typing import ClassVar as _ClassVar
from gazelle_ros.messages import Message as _Message
from gazelle_ros.messages import ServiceDefinition as _ServiceDefinition

class DemuxAddRequest(_Message):
    topic: str
    def __init__(self, topic: str | None = ...) -> None: ...
class DemuxAddResponse(_Message):
    def __init__(self) -> None: ...
class DemuxAdd(_ServiceDefinition):
    _request_class: _ClassVar[type[DemuxAddRequest]]
    _response_class: _ClassVar[type[DemuxAddResponse]]
class DemuxDeleteRequest(_Message):
    topic: str
    def __init__(self, topic: str | None = ...) -> None: ...
class DemuxDeleteResponse(_Message):
    def __init__(self) -> None: ...
class DemuxDelete(_ServiceDefinition):
    _request_class: _ClassVar[type[DemuxDeleteRequest]]
    _response_class: _ClassVar[type[DemuxDeleteResponse]]
class DemuxListRequest(_Message):
    def __init__(self) -> None: ...
class DemuxListResponse(_Message):
    topics: list[str]
    def __init__(self, topics: list[str] | None = ...) -> None: ...
class DemuxList(_ServiceDefinition):
    _request_class: _ClassVar[type[DemuxListRequest]]
    _response_class: _ClassVar[type[DemuxListResponse]]
class DemuxSelectRequest(_Message):
    topic: str
    def __init__(self, topic: str | None = ...) -> None: ...
class DemuxSelectResponse(_Message):
    prev_topic: str
    def __init__(self, prev_topic: str | None = ...) -> None: ...
class DemuxSelect(_ServiceDefinition):
    _request_class: _ClassVar[type[DemuxSelectRequest]]
    _response_class: _ClassVar[type[DemuxSelectResponse]]
class MuxAddRequest(_Message):
    topic: str
    def __init__(self, topic: str | None = ...) -> None: ...
class MuxAddResponse(_Message):
    def __init__(self) -> None: ...
class MuxAdd(_ServiceDefinition):
    _request_class: _ClassVar[type[MuxAddRequest]]
    _response_class: _ClassVar[type[MuxAddResponse]]
class MuxDeleteRequest(_Message):
    topic: str
    def __init__(self, topic: str | None = ...) -> None: ...
class MuxDeleteResponse(_Message):
    def __init__(self) -> None: ...
class MuxDelete(_ServiceDefinition):
    _request_class: _ClassVar[type[MuxDeleteRequest]]
    _response_class: _ClassVar[type[MuxDeleteResponse]]
class MuxListRequest(_Message):
    def __init__(self) -> None: ...
class MuxListResponse(_Message):
    topics: list[str]
    def __init__(self, topics: list[str] | None = ...) -> None: ...
class MuxList(_ServiceDefinition):
    _request_class: _ClassVar[type[MuxListRequest]]
    _response_class: _ClassVar[type[MuxListResponse]]
class MuxSelectRequest(_Message):
    topic: str
    def __init__(self, topic: str | None = ...) -> None: ...
class MuxSelectResponse(_Message):
    prev_topic: str
    def __init__(self, prev_topic: str | None = ...) -> None: ...
class MuxSelect(_ServiceDefinition):
    _request_class: _ClassVar[type[MuxSelectRequest]]
    _response_class: _ClassVar[type[MuxSelectResponse]]
