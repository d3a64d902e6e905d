"""Ports that belong to nobody else."""

import socket
import sys

_held: list[socket.socket] = []


def free_port() -> int:
    """Return a free port of this machine, reserved against other processes.

    A port that is only looked up and closed again may be given to another process before it is
    used. So a socket keeps it until this process ends: as it does not listen, connections are
    refused, and on Linux whoever asks for just this port with ``SO_REUSEADDR``, as servers do,
    shares it.
    """
    sock = socket.socket()
    sock.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    sock.bind(("127.0.0.1", 0))
    port = sock.getsockname()[1]
    if sys.platform == "linux":
        _held.append(sock)
    else:
        sock.close()
    return port
