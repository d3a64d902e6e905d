# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from typing import ClassVar as _ClassVar
from gazelle_ros.messages import Message as _Message
from gazelle_ros.time import Duration as _Duration
from gazelle_ros.time import Time as _Time
from gazelle_ros.msgs.std_msgs import msg as _std_msgs

class Clock(_Message):
    clock: _Time
    def __init__(self, clock: _Time | None = ...) -> None: ...
class Log(_Message):
    DEBUG: _ClassVar[int]
    INFO: _ClassVar[int]
    WARN: _ClassVar[int]
    ERROR: _ClassVar[int]
    FATAL: _ClassVar[int]
    header: _std_msgs.Header
    level: int
    name: str
    msg: str
    file: str
    function: str
    line: int
    topics: list[str]
    def __init__(self, header: _std_msgs.Header | None = ..., level: int | None = ..., name: str | None = ..., msg: str | None = ..., file: str | None = ..., function: str | None = ..., line: int | None = ..., topics: list[str] | None = ...) -> None: ...
class TopicStatistics(_Message):
    topic: str
    node_pub: str
    node_sub: str
    window_start: _Time
    window_stop: _Time
    delivered_msgs: int
    dropped_msgs: int
    traffic: int
    period_mean: _Duration
    period_stddev: _Duration
    period_max: _Duration
    stamp_age_mean: _Duration
    stamp_age_stddev: _Duration
    stamp_age_max: _Duration
    def __init__(self, topic: str | None = ..., node_pub: str | None = ..., node_sub: str | None = ..., window_start: _Time | None = ..., window_stop: _Time | None = ..., delivered_msgs: int | None = ..., dropped_msgs: int | None = ..., traffic: int | None = ..., period_mean: _Duration | None = ..., period_stddev: _Duration | None = ..., period_max: _Duration | None = ..., stamp_age_mean: _Duration | None = ..., stamp_age_stddev: _Duration | None = ..., stamp_age_max: _Duration | None = ...) -> None: ...
