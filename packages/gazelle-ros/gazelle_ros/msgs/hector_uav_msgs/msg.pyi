# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from gazelle_ros.messages import Message as _Message
from gazelle_ros.msgs.std_msgs import msg as _std_msgs

class Altimeter(_Message):
    header: _std_msgs.Header
    altitude: float
    pressure: float
    qnh: float
    def __init__(self, header: _std_msgs.Header | None = ..., altitude: float | None = ..., pressure: float | None = ..., qnh: float | None = ...) -> None: ...
