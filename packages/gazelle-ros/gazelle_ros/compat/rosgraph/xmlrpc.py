"""XML-RPC servers as Python's standard library has them, answering several callers at once."""

from __future__ import annotations

from socketserver import ThreadingMixIn
from typing import Any
from xmlrpc.server import SimpleXMLRPCRequestHandler, SimpleXMLRPCServer


class SilenceableXMLRPCRequestHandler(SimpleXMLRPCRequestHandler):
    """Keeps connections, and does not log requests."""

    protocol_version = "HTTP/1.1"

    def log_message(self, format: str, *args: Any) -> None:  # noqa: A002  # the base's name
        """Log nothing."""


class ThreadingXMLRPCServer(ThreadingMixIn, SimpleXMLRPCServer):
    """A server with a thread for each connection.

    Args:
        addr: Host and port.
        log_requests: Write a line for each request.
    """

    daemon_threads = True

    def __init__(self, addr: tuple[str, int], log_requests: bool = True) -> None:  # noqa: FBT001, FBT002  # rosgraph's interface
        super().__init__(addr, SilenceableXMLRPCRequestHandler, log_requests)


class XmlRpcHandler:
    """Derive from it to offer methods."""

    def _ready(self, uri: str) -> None:
        """Handle the start of the server at an address."""

    def _shutdown(self, reason: str) -> None:
        """Handle the end of the server."""
