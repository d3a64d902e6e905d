"""A way to a service on which answers get lost."""

from __future__ import annotations

import contextlib
import socket
import struct
import threading


class FlakyService:
    """Stands before a service of a graph: what is asked is done, but answers are lost.

    Args:
        node: Tells the master that the service is here now.
        name: Of the service.
        lost: How many answers are lost before the first goes through.
    """

    def __init__(self, node, name, lost):
        self.lost, self.calls = lost, 0
        uri = node.master.lookup_service(name)
        host, _, port = uri.removeprefix("rosrpc://").partition(":")
        self._target = (host, int(port.rstrip("/")))
        self._listener = socket.create_server(("127.0.0.1", 0))
        address = f"rosrpc://127.0.0.1:{self._listener.getsockname()[1]}"
        node.master.register_service(name, address, node.uri)
        threading.Thread(target=self._listen, daemon=True).start()

    def close(self):
        self._listener.close()

    def _listen(self):
        with contextlib.suppress(OSError):
            while True:
                peer, _ = self._listener.accept()
                threading.Thread(target=self._relay, args=(peer,), daemon=True).start()

    def _relay(self, peer):
        with peer, socket.create_connection(self._target) as server, contextlib.suppress(OSError):
            _forward(peer, server)
            _forward(server, peer)
            while _forward(peer, server):
                self.calls += 1
                answer = server.recv(1)
                if self.lost > 0:
                    self.lost -= 1
                    return
                peer.sendall(answer)
                _forward(server, peer)


def _forward(source, target):
    """Forward one length and its bytes; return False at the end."""
    head = _take(source, 4)
    if len(head) < 4:
        return False
    target.sendall(head + _take(source, struct.unpack("<I", head)[0]))
    return True


def _take(source, count):
    data = b""
    while len(data) < count and (part := source.recv(count - len(data))):
        data += part
    return data
