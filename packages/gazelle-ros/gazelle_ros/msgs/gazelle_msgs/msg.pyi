# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from gazelle_ros.messages import Message as _Message
from gazelle_ros.msgs.std_msgs import msg as _std_msgs

class Blob(_Message):
    color: _std_msgs.ColorRGBA
    left: int
    right: int
    range: float
    def __init__(self, color: _std_msgs.ColorRGBA | None = ..., left: int | None = ..., right: int | None = ..., range: float | None = ...) -> None: ...
class Blobs(_Message):
    header: _std_msgs.Header
    width: int
    blobs: list[Blob]
    def __init__(self, header: _std_msgs.Header | None = ..., width: int | None = ..., blobs: list[Blob] | None = ...) -> None: ...
class Bumper(_Message):
    header: _std_msgs.Header
    touched: list[str]
    def __init__(self, header: _std_msgs.Header | None = ..., touched: list[str] | None = ...) -> None: ...
class Fiducial(_Message):
    name: str
    id: int
    range: float
    bearing: float
    heading: float
    def __init__(self, name: str | None = ..., id: int | None = ..., range: float | None = ..., bearing: float | None = ..., heading: float | None = ...) -> None: ...
class Fiducials(_Message):
    header: _std_msgs.Header
    fiducials: list[Fiducial]
    def __init__(self, header: _std_msgs.Header | None = ..., fiducials: list[Fiducial] | None = ...) -> None: ...
class Gripper(_Message):
    header: _std_msgs.Header
    paddles: float
    lift: float
    beams: list[bool]
    carried: str
    def __init__(self, header: _std_msgs.Header | None = ..., paddles: float | None = ..., lift: float | None = ..., beams: list[bool] | None = ..., carried: str | None = ...) -> None: ...
