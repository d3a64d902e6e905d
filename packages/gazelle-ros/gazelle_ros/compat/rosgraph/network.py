"""Addresses and connection headers."""

from __future__ import annotations

import contextlib
import os
import socket
from urllib.parse import urlparse

from gazelle_ros import net
from gazelle_ros.tcpros import headers


class ROSHandshakeException(Exception):  # noqa: N818  # rosgraph's name
    """A connection header is malformed."""


def parse_http_host_and_port(url: str) -> tuple[str, int]:
    """Parse host and port of an address.

    Raises:
        ValueError: It is none.
    """
    parts = urlparse(url)
    if not parts.hostname:
        raise ValueError("not a valid URL")
    return parts.hostname, parts.port or 80


def get_address_override() -> str | None:
    """Return the value of ROS_HOSTNAME or ROS_IP."""
    return os.environ.get("ROS_HOSTNAME") or os.environ.get("ROS_IP") or None


def get_local_address() -> str:
    """Return this machine's address for other nodes."""
    return net.default_host()


get_host_name = get_local_address


def get_local_addresses() -> list[str]:
    """Return addresses of this machine."""
    found = {net.LOOPBACK}
    with contextlib.suppress(OSError):
        found.update(net.addresses_of(socket.gethostname()))
    return sorted(found)


def is_local_address(hostname: str) -> bool:
    """Return whether a name means this machine."""
    try:
        return net.find_address(hostname) in get_local_addresses()
    except OSError:
        return False


def get_bind_address(address: str | None = None) -> str:
    """Return the address to listen on."""
    return net.bind_address(address or net.default_host())


def use_ipv6() -> bool:
    """Return whether ROS_IPV6 asks for version 6 of the internet protocol."""
    return os.environ.get("ROS_IPV6") == "on"


def create_local_xmlrpc_uri(port: int) -> str:
    """Return the address of an XML-RPC server on this machine."""
    return net.uri_of(net.default_host(), port)


def encode_ros_handshake_header(header: dict[str, str]) -> bytes:
    """Encode a connection header for the wire."""
    return headers.encode({key: str(value) for key, value in header.items()})


def decode_ros_handshake_header(header_str: bytes) -> dict[str, str]:
    """Decode a connection header from the wire.

    Raises:
        ROSHandshakeException: It is malformed.
    """
    from gazelle_ros.errors import RosError

    try:
        return headers.decode(header_str[4:])
    except RosError as error:
        raise ROSHandshakeException(str(error)) from None
