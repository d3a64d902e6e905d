# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from gazelle_ros.messages import Message as _Message

class UniqueID(_Message):
    uuid: bytes
    def __init__(self, uuid: bytes | None = ...) -> None: ...
