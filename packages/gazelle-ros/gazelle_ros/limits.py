"""Limits for peers; one that exceeds them is disconnected, and no other is affected."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class NetworkLimits:
    """Limits on data from the network."""

    message_bytes: int = 1_000_000_000
    """Longest message, request or response; the bound of the C++ client library."""
    header_bytes: int = 4 * 1024 * 1024
    """Longest TCPROS connection header (it has the full message definition)."""
    http_header_bytes: int = 64 * 1024
    """Longest request or status line with all header lines."""
    xml_bytes: int = 64 * 1024 * 1024
    """Longest XML-RPC document; robot descriptions are the longest in practice."""
    xml_depth: int = 100
    """Deepest nesting of arrays and structs."""
    xml_values: int = 1_000_000
    """Most values in one document."""
    connections: int = 10_000
    """Most connections a server accepts at a time."""
    idle_seconds: float = 600.0
    """An XML-RPC connection that is silent for so long may be closed."""
    handshake_seconds: float = 15.0
    """A TCPROS peer must have sent its header by then."""
    receive_backlog_bytes: int = 4 * 1024 * 1024
    """A subscriber without queue size stops reading beyond this until callbacks catch up."""


LIMITS = NetworkLimits()
