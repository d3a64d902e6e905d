# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from gazelle_ros.messages import Message as _Message

class UsvDrive(_Message):
    left: float
    right: float
    def __init__(self, left: float | None = ..., right: float | None = ...) -> None: ...
