# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from typing import ClassVar as _ClassVar
from gazelle_ros.messages import Message as _Message
from gazelle_ros.messages import ServiceDefinition as _ServiceDefinition
from gazelle_ros.time import Duration as _Duration

class RepublishTFsRequest(_Message):
    source_frames: list[str]
    target_frame: str
    angular_thres: float
    trans_thres: float
    rate: float
    timeout: _Duration
    def __init__(self, source_frames: list[str] | None = ..., target_frame: str | None = ..., angular_thres: float | None = ..., trans_thres: float | None = ..., rate: float | None = ..., timeout: _Duration | None = ...) -> None: ...
class RepublishTFsResponse(_Message):
    topic_name: str
    def __init__(self, topic_name: str | None = ...) -> None: ...
class RepublishTFs(_ServiceDefinition):
    _request_class: _ClassVar[type[RepublishTFsRequest]]
    _response_class: _ClassVar[type[RepublishTFsResponse]]
