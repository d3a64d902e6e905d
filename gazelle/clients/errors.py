"""Errors of clients."""

from __future__ import annotations

from gazelle.errors import RosError


class ClientError(RosError):
    """The other side said no, or did not answer; the message says what it said."""
