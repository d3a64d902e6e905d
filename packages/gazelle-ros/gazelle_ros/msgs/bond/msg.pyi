# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from typing import ClassVar as _ClassVar
from gazelle_ros.messages import Message as _Message
from gazelle_ros.msgs.std_msgs import msg as _std_msgs

class Constants(_Message):
    DEAD_PUBLISH_PERIOD: _ClassVar[float]
    DEFAULT_CONNECT_TIMEOUT: _ClassVar[float]
    DEFAULT_HEARTBEAT_TIMEOUT: _ClassVar[float]
    DEFAULT_DISCONNECT_TIMEOUT: _ClassVar[float]
    DEFAULT_HEARTBEAT_PERIOD: _ClassVar[float]
    DISABLE_HEARTBEAT_TIMEOUT_PARAM: _ClassVar[str]
    def __init__(self) -> None: ...
class Status(_Message):
    header: _std_msgs.Header
    id: str
    instance_id: str
    active: bool
    heartbeat_timeout: float
    heartbeat_period: float
    def __init__(self, header: _std_msgs.Header | None = ..., id: str | None = ..., instance_id: str | None = ..., active: bool | None = ..., heartbeat_timeout: float | None = ..., heartbeat_period: float | None = ...) -> None: ...
