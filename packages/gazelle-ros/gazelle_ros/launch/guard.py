"""Ends nodes whose launcher was killed before it could end them."""

from __future__ import annotations

import contextlib
import os
import subprocess
import sys
import threading

# Runs in a process of its own. It lives as long as the pipe from the launcher does, and ends what is left
# when that breaks. Only the standard library, and no site-packages, so that it starts quickly.
_SCRIPT = """
import os, signal, sys, time
left = set()
for line in sys.stdin:
    word, _, number = line.partition(" ")
    if word == "done":
        raise SystemExit
    (left.add if word == "watch" else left.discard)(int(number))
def send(number):
    for each in list(left):
        try:
            os.killpg(each, number)
        except OSError:
            left.discard(each)
for number, seconds in ((signal.SIGINT, 5.0), (signal.SIGTERM, 2.0), (signal.SIGKILL, 0.0)):
    send(number)
    end = time.monotonic() + seconds
    while left and time.monotonic() < end:
        time.sleep(0.05)
        send(0)
"""
_HAS_GROUPS = hasattr(os, "killpg")


class LaunchWatchdog:
    """A small process that outlives this one for a moment if this one is killed.

    It gets every node as soon as that has started (what is killed between the two, leaves that node);
    on Windows there is none.
    """

    def __init__(self) -> None:
        self._process: subprocess.Popen[bytes] | None = None
        self._lock = threading.Lock()

    def start(self) -> None:
        """Start it, before the first node."""
        if not _HAS_GROUPS:
            return
        with self._lock:
            if self._process is None:
                self._process = subprocess.Popen(  # noqa: S603  # the script above
                    [sys.executable, "-I", "-S", "-c", _SCRIPT],
                    stdin=subprocess.PIPE,
                    stdout=subprocess.DEVNULL,
                    stderr=subprocess.DEVNULL,
                    start_new_session=True,
                )

    def watch(self, group: int) -> None:
        """Register a process group to end if this process is killed."""
        self._send(f"watch {group}")

    def forget(self, group: int) -> None:
        """Unregister a process group that has ended; its number may be another's by now."""
        self._send(f"forget {group}")

    def close(self) -> None:
        """Stop: all groups have ended."""
        with self._lock:
            process, self._process = self._process, None
        if process is None:
            return
        _write(process, "done")
        if process.stdin is not None:
            with contextlib.suppress(OSError):
                process.stdin.close()
        process.wait()

    def _send(self, line: str) -> None:
        with self._lock:
            if self._process is not None:
                _write(self._process, line)


def _write(process: subprocess.Popen[bytes], line: str) -> None:
    if process.stdin is not None:
        with contextlib.suppress(OSError):
            process.stdin.write(f"{line}\n".encode())
            process.stdin.flush()
