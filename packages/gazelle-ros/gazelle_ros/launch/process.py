"""One node as a process: start it, watch it, end it with all that it started."""

from __future__ import annotations

import contextlib
import math
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import IO

from gazelle_ros.base.interrupts import holding
from gazelle_ros.launch.errors import LaunchError
from gazelle_ros.launch.plan import NodePlan

_HAS_GROUPS = hasattr(os, "killpg")
"""False on Windows: there the process alone is ended."""
_POLL_S = 0.02
_ORPHAN_S = 0.5
"""Time that processes started by a node may outlive it."""
_STARTING_S = 1.0
"""Time in which Python is taken to be starting."""


@dataclass(frozen=True, slots=True)
class StopTimeouts:
    """Time that a process may take to end after a signal."""

    interrupt: float = 15.0
    """Seconds after SIGINT."""
    terminate: float = 2.0
    """Seconds after SIGTERM, before SIGKILL."""


@dataclass(frozen=True, slots=True)
class Start:
    """Start parameters of a process."""

    arguments: tuple[str, ...]
    environment: dict[str, str]
    folder: Path
    log: Path | None
    """File of standard output; None for that of this process."""


def _terminal_input() -> int | None:
    """Return the standard input of nodes: the launcher's terminal, if any, as with roslaunch."""
    return None if sys.stdin is not None and sys.stdin.isatty() else subprocess.DEVNULL


class NodeProcess:
    """A node's process, which may be started again and again.

    Args:
        plan: The node.
        name: Name in messages, such as ``talker-1``.
        start: Start settings.

    Attributes:
        ended_at: Time when it was last seen to have ended; None while it runs.
        spawned: Number of starts.
    """

    def __init__(self, plan: NodePlan, name: str, start: Start) -> None:
        self.plan = plan
        self.name = name
        self.how = start
        self.ended_at: float | None = None
        self.spawned = 0
        self._started_at = -math.inf
        self._process: subprocess.Popen[bytes] | None = None

    @property
    def pid(self) -> int:
        """Number of the process; -1 before it was started."""
        return -1 if self._process is None else self._process.pid

    def _opened_log(self) -> IO[bytes] | None:
        if self.how.log is None:
            return None
        try:
            return self.how.log.open("ab" if self.spawned else "wb")
        except OSError as error:
            raise LaunchError(
                f"the log cannot be written: {error.strerror}", file=str(self.how.log)
            ) from None

    def start(self) -> None:
        """Start it, in a session of its own, so that signals reach all that it starts.

        Raises:
            LaunchError: The program cannot be executed.
        """
        self._end_group()
        log = self._opened_log()
        try:
            with holding():
                self._process = subprocess.Popen(  # noqa: S603  # nodes are what launch files name
                    self.how.arguments,
                    env=self.how.environment,
                    cwd=self.how.folder,
                    stdin=_terminal_input(),
                    stdout=log,
                    start_new_session=True,
                )
        except OSError as error:
            raise LaunchError(
                f"'{self.how.arguments[0]}' cannot be started: {error.strerror}",
                source=self.plan.place,
            ) from None
        finally:
            if log is not None:
                log.close()
        self.ended_at = None
        self._started_at = time.monotonic()
        self.spawned += 1

    def poll(self) -> int | None:
        """Return its exit code, negative for a signal; None while it runs."""
        if self._process is None:
            return None
        code = self._process.poll()
        if code is not None and self.ended_at is None:
            self.ended_at = time.monotonic()
        return code

    @property
    def running(self) -> bool:
        """True if it was started and did not end."""
        return self._process is not None and self.poll() is None

    def signal(self, number: int) -> None:
        """Send a signal to the process and all that it started."""
        if self._process is None:
            return
        if not _HAS_GROUPS:
            self._process.terminate()
            return
        with contextlib.suppress(ProcessLookupError, PermissionError):
            os.killpg(self._process.pid, number)

    def interrupt(self) -> None:
        """Send SIGINT; SIGTERM while Python starts, which reports SIGINT at length then."""
        starting = time.monotonic() < self._started_at + _STARTING_S
        python = self.how.arguments[0] == sys.executable
        self.signal(signal.SIGTERM if python and starting else signal.SIGINT)

    def _end_group(self) -> None:
        """Stop the processes that the process left."""
        if self._process is None or not self._group_lives():
            return
        self.signal(signal.SIGTERM)
        deadline = time.monotonic() + _ORPHAN_S
        while self._group_lives() and time.monotonic() < deadline:
            time.sleep(_POLL_S)
        self.signal(signal.SIGKILL)

    def _group_lives(self) -> bool:
        if self._process is None or not _HAS_GROUPS:
            return False
        try:
            os.killpg(self._process.pid, 0)
        except (ProcessLookupError, PermissionError):
            return False
        return True

    def finish(self) -> None:
        """Kill the process and its children if they still run, and collect its exit code."""
        if self._process is None:
            return
        if self.poll() is None:
            self.signal(signal.SIGKILL)
            self._process.wait()
            self.poll()
        self._end_group()


def stop_all(
    processes: Iterable[NodeProcess], patience: StopTimeouts, first: int = signal.SIGINT
) -> list[NodeProcess]:
    """Stop processes, all at the same time: SIGINT, then SIGTERM, then SIGKILL.

    Args:
        processes: Processes to end.
        patience: Longest time.
        first: Signal to send instead of SIGINT.

    Returns:
        Those that took more than the first signal.
    """
    all_of_them = list(processes)
    _send(all_of_them, first, patience.interrupt)
    stubborn = _send(all_of_them, signal.SIGTERM, patience.terminate)
    for each in all_of_them:
        each.finish()
    return stubborn


def _send(processes: list[NodeProcess], number: int, seconds: float) -> list[NodeProcess]:
    """Send a signal to those that run, and wait for their end; returns its receivers."""
    alive = [each for each in processes if each.running]
    for each in alive:
        if number == signal.SIGINT:
            each.interrupt()
        else:
            each.signal(number)
    deadline = time.monotonic() + seconds
    while any(each.running for each in alive) and time.monotonic() < deadline:
        time.sleep(_POLL_S)
    return alive
