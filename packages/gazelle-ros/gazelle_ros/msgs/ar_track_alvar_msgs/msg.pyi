# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from gazelle_ros.messages import Message as _Message
from gazelle_ros.msgs.geometry_msgs import msg as _geometry_msgs
from gazelle_ros.msgs.std_msgs import msg as _std_msgs

class AlvarMarker(_Message):
    header: _std_msgs.Header
    id: int
    confidence: int
    pose: _geometry_msgs.PoseStamped
    def __init__(self, header: _std_msgs.Header | None = ..., id: int | None = ..., confidence: int | None = ..., pose: _geometry_msgs.PoseStamped | None = ...) -> None: ...
class AlvarMarkers(_Message):
    header: _std_msgs.Header
    markers: list[AlvarMarker]
    def __init__(self, header: _std_msgs.Header | None = ..., markers: list[AlvarMarker] | None = ...) -> None: ...
