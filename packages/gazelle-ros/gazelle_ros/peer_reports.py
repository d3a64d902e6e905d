"""Log of peers' faults, one line each and limited in rate."""

from __future__ import annotations

import threading
import time
from dataclasses import dataclass

from gazelle_ros.errors import ProtocolError, report

_PAUSE_S = 10.0
"""Between two lines about one peer [s]."""
_MOST = 256
"""Peers that are remembered."""


@dataclass(slots=True)
class _Account:
    """Reports on one peer."""

    said: float
    unreported: int = 0


class PeerReports:
    """Complaints about peers, at most one in ten seconds for each."""

    def __init__(self) -> None:
        self._accounts: dict[tuple[str, str], _Account] = {}
        self._lock = threading.Lock()

    def complain(self, what: str, peer: str, error: BaseException) -> None:
        """Report a message that cannot be read; a traceback would show our code, not the fault.

        Args:
            what: Purpose, such as ``subscriber of /scan``.
            peer: The sender.
            error: Error.
        """
        now = time.monotonic()
        with self._lock:
            account = self._accounts.get((what, peer))
            if account is not None and now - account.said < _PAUSE_S:
                account.unreported += 1
                return
            more = f" ({account.unreported} more since the last report)" if account else ""
            if len(self._accounts) >= _MOST:
                self._accounts.pop(next(iter(self._accounts)))
            self._accounts[what, peer] = _Account(now)
        text = " ".join(f"{type(error).__name__}: {error}".split())[:200]
        report(what, ProtocolError(f"malformed message from {peer}: {text}{more}"))


PEER_REPORTS = PeerReports()
"""Those of this process."""
