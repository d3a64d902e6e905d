# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from gazelle_ros.messages import Message as _Message

class Logger(_Message):
    name: str
    level: str
    def __init__(self, name: str | None = ..., level: str | None = ...) -> None: ...
