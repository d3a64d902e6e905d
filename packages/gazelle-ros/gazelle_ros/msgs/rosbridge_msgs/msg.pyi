# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from gazelle_ros.messages import Message as _Message
from gazelle_ros.time import Time as _Time

class ConnectedClient(_Message):
    ip_address: str
    connection_time: _Time
    def __init__(self, ip_address: str | None = ..., connection_time: _Time | None = ...) -> None: ...
class ConnectedClients(_Message):
    clients: list[ConnectedClient]
    def __init__(self, clients: list[ConnectedClient] | None = ...) -> None: ...
