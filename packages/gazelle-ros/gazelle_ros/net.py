"""Sockets, addresses and the names other machines reach this one by."""

from __future__ import annotations

import contextlib
import errno
import ipaddress
import os
import socket
import threading
import time
from collections.abc import Callable
from urllib.parse import urlsplit

from gazelle_ros.errors import ProtocolError

LOOPBACK = "127.0.0.1"
DEFAULT_MASTER_PORT = 11311
MAX_PORT = 65535
_CACHE_SECONDS = 60.0

Address = tuple[str, int]


def default_master_uri() -> str:
    """Return `ROS_MASTER_URI`, else the usual port on this machine."""
    return os.environ.get("ROS_MASTER_URI") or f"http://{LOOPBACK}:{DEFAULT_MASTER_PORT}"


def default_host() -> str:
    """Return the name of this machine for peers: `ROS_HOSTNAME`, else `ROS_IP`, else loopback."""
    return usable_host(os.environ.get("ROS_HOSTNAME") or os.environ.get("ROS_IP") or LOOPBACK)


def usable_host(host: str) -> str:
    """Return a name for peers: for "all addresses" (``0.0.0.0``) that of the network interface.

    Without a network that is loopback.
    """
    try:
        if not ipaddress.ip_address(host).is_unspecified:
            return host
    except ValueError:
        return host
    outside, family = ("2001:db8::1", socket.AF_INET6) if ":" in host else ("192.0.2.1", None)
    with (
        contextlib.suppress(OSError),
        socket.socket(family or socket.AF_INET, socket.SOCK_DGRAM) as probe,
    ):
        probe.connect((outside, 9))  # nothing is sent; the system chooses an address
        return str(probe.getsockname()[0])
    return "::1" if family else LOOPBACK


def bind_address(host: str) -> str:
    """Return the address to listen on so that `host` reaches us: loopback, or all interfaces."""
    if host == "localhost":
        return LOOPBACK
    with contextlib.suppress(ValueError):
        if ipaddress.ip_address(host).is_loopback:
            return host
    return "::" if ":" in host else "0.0.0.0"  # noqa: S104  # the user named an outside address


def listen(host: str, port: int = 0) -> socket.socket:
    """Return a non-blocking listening TCP socket.

    Args:
        host: The name peers use; it decides the interface, see `bind_address`.
        port: 0 for any free one.

    Raises:
        OSError: There is no such port, or it is taken.
    """
    if not 0 <= port <= MAX_PORT:
        raise OSError(errno.EINVAL, f"a port is from 0 to {MAX_PORT}")
    address = bind_address(host)
    sock = socket.socket(socket.AF_INET6 if ":" in address else socket.AF_INET)
    try:
        sock.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        sock.bind((address, port))
        sock.listen(1024)
        sock.setblocking(False)
    except BaseException:
        sock.close()
        raise
    return sock


def split_uri(uri: str, scheme: str = "http") -> tuple[str, int, str]:
    """Return host, port and path of a URI.

    Raises:
        ProtocolError: It is no such URI.
    """
    try:
        parts = urlsplit(uri)
        host, port = parts.hostname, parts.port
    except ValueError as error:
        raise ProtocolError(f"'{uri}' is not a URI: {error}") from None
    if parts.scheme != scheme or not host:
        raise ProtocolError(f"'{uri}' is not a URI of the form {scheme}://HOST:PORT")
    if port is None:
        if scheme != "http":
            raise ProtocolError(f"'{uri}' has no port")
        port = 80
    return host, port, parts.path or "/"


def uri_of(host: str, port: int, scheme: str = "http") -> str:
    """Return the URI of a server on this machine."""
    name = f"[{host}]" if ":" in host else host
    return f"{scheme}://{name}:{port}" + ("/" if scheme == "http" else "")


_names: dict[str, tuple[float, str]] = {}
_names_lock = threading.Lock()


def is_loopback(host: str) -> bool:
    """Return whether an address, or a name, is this machine's own alone."""
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return host == "localhost"


def known_address(host: str) -> str | None:
    """Return the numeric address of `host` if that needs no name server, else None."""
    if host == "localhost":
        return LOOPBACK
    with contextlib.suppress(ValueError):
        return str(ipaddress.ip_address(host))
    with _names_lock:
        found = _names.get(host)
    return found[1] if found and found[0] > time.monotonic() else None


def find_address(host: str) -> str:
    """Return the numeric address of `host`; may ask a name server and take seconds.

    Raises:
        OSError: There is no such host.
    """
    known = known_address(host)
    if known is not None:
        return known
    address = addresses_of(host)[0]
    with _names_lock:
        if len(_names) > 1000:
            _names.clear()
        _names[host] = (time.monotonic() + _CACHE_SECONDS, address)
    return address


def addresses_of(host: str) -> list[str]:
    """Return the numeric addresses of a host, those of IPv4 first; may take seconds.

    Raises:
        OSError: There is no such host.
    """
    try:
        found = socket.getaddrinfo(host, None, type=socket.SOCK_STREAM)
    except UnicodeError:  # empty, too long, or with characters that names do not have
        raise OSError(f"{host!r} is not a name of a host") from None
    families = sorted(found, key=lambda entry: entry[0] != socket.AF_INET)
    return [str(entry[4][0]) for entry in families]


def start_connect(address: str, port: int) -> socket.socket:
    """Return a non-blocking socket while it connects to a numeric address.

    Raises:
        OSError: It failed at once.
    """
    sock = socket.socket(socket.AF_INET6 if ":" in address else socket.AF_INET)
    try:
        sock.setblocking(False)
        with contextlib.suppress(BlockingIOError):
            sock.connect((address, port))
        _refuse_self(sock)
    except BaseException:
        sock.close()
        raise
    return sock


def connect(host: str, port: int, timeout: float | None) -> socket.socket:
    """Return a blocking socket, connected.

    Raises:
        OSError: It failed.
    """
    sock = socket.create_connection((find_address(host), port), timeout=timeout)
    try:
        _refuse_self(sock)
    except BaseException:
        sock.close()
        raise
    return sock


def _refuse_self(sock: socket.socket) -> None:
    """Raise an error for a connection of a local port to itself, which means there is no server."""
    with contextlib.suppress(OSError):
        if sock.getsockname() == sock.getpeername():
            raise ConnectionRefusedError("connection refused")


def ignore_delay(sock: socket.socket) -> None:
    """Send small packets at once."""
    with contextlib.suppress(OSError):
        sock.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)


def keep_alive(sock: socket.socket) -> None:
    """Set the system to detect that a silent peer is gone."""
    with contextlib.suppress(OSError):
        sock.setsockopt(socket.SOL_SOCKET, socket.SO_KEEPALIVE, 1)
        if hasattr(socket, "TCP_KEEPIDLE"):
            sock.setsockopt(socket.IPPROTO_TCP, socket.TCP_KEEPIDLE, 60)
            sock.setsockopt(socket.IPPROTO_TCP, socket.TCP_KEEPINTVL, 10)
            sock.setsockopt(socket.IPPROTO_TCP, socket.TCP_KEEPCNT, 9)


def accept_all(
    listener: socket.socket, adopt: Callable[[socket.socket, Address], None], most: int = 64
) -> bool:
    """Accept waiting connections, at most `most` of them.

    Returns:
        False if the process has no file descriptor left; listening again at once is vain.
    """
    for _ in range(most):
        try:
            sock, address = listener.accept()
        except (BlockingIOError, InterruptedError, ConnectionAbortedError):
            return True
        except OSError:
            return False
        sock.setblocking(False)
        adopt(sock, (str(address[0]), int(address[1])))
    return True
