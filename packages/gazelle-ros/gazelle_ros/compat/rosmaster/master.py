"""A master as an object that is started and stopped."""

from __future__ import annotations

from gazelle_ros import net
from gazelle_ros.compat.rosmaster.master_api import NUM_WORKERS
from gazelle_ros.master.server import Master as Running

DEFAULT_MASTER_PORT = 11311


class Master:
    """A master, with the parameters of a session but without /rosout, as rosmaster's.

    Args:
        port: Port; 0 for any free port.
        num_workers: Accepted, and not needed.

    Attributes:
        uri: Address; None before it is started.
    """

    def __init__(self, port: int = DEFAULT_MASTER_PORT, num_workers: int = NUM_WORKERS) -> None:
        del num_workers
        self.port = port
        self.uri: str | None = None
        self._running: Running | None = None

    def start(self) -> None:
        """Start the master.

        Raises:
            OSError: The port is taken.
        """
        self._running = Running(net.default_host(), self.port, rosout=False)
        self.uri = self._running.uri

    def ok(self) -> bool:
        """Return whether it answers."""
        return self._running is not None and not self._running.ended.is_set()

    def stop(self) -> None:
        """Stop the master."""
        if self._running is not None:
            self._running.close()
            self._running = None
