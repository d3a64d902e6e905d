# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from gazelle_ros.messages import Message as _Message
from gazelle_ros.msgs.geometry_msgs import msg as _geometry_msgs

class tfMessage(_Message):
    transforms: list[_geometry_msgs.TransformStamped]
    def __init__(self, transforms: list[_geometry_msgs.TransformStamped] | None = ...) -> None: ...
