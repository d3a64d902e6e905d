"""Programs that run in place of this process, or beside a block and never longer."""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import sys
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from gazelle_ros.base.interrupts import holding


def become(command: Sequence[str], environment: Mapping[str, str] | None = None) -> int:
    """Run a program in place of this process, so that every signal reaches it.

    Returns:
        Its exit code, on Windows; elsewhere the call does not return.

    Raises:
        OSError: The program cannot be executed.
    """
    env = os.environ if environment is None else environment
    if os.name == "posix":
        for stream in (sys.stdout, sys.stderr):
            stream.flush()
        for number in (signal.SIGPIPE, signal.SIGXFSZ):  # programs inherit that Python ignores them
            signal.signal(number, signal.SIG_DFL)
        os.execvpe(command[0], list(command), env)  # noqa: S606  # to run it is the purpose
    return subprocess.call(command, env=env)  # noqa: S603  # the same


@contextlib.contextmanager
def child_process(command: Sequence[str], **options: Any) -> Iterator[subprocess.Popen[bytes]]:
    """Run a program; it is killed at the end of the block unless it has ended.

    An interrupt within ``Popen`` would leave a process that is unknown.

    Args:
        command: The program and its arguments.
        options: Of `subprocess.Popen`.

    Raises:
        OSError: The program cannot be executed.
        Interrupted: The process was interrupted meanwhile.
    """
    process: subprocess.Popen[bytes] | None = None
    try:
        with holding():
            process = subprocess.Popen(command, **options)  # noqa: S603  # to run it is the purpose
        yield process
    finally:
        if process is not None:
            with process:  # closes its pipes
                process.kill()


def descendants(process: int | None = None) -> list[int]:
    """Return the processes that one started, this one if None, and those that they did.

    Parents come first. None without ``/proc``.
    """
    children: dict[int, list[int]] = {}
    for stat in Path("/proc").glob("[0-9]*/stat"):
        with contextlib.suppress(OSError):  # it has ended
            parent = stat.read_text(errors="replace").rpartition(")")[2].split()[1]
            children.setdefault(int(parent), []).append(int(stat.parent.name))
    found = [os.getpid() if process is None else process]
    for parent_id in found:
        found += children.get(parent_id, [])
    return found[1:]


def command_line(process: int) -> str:
    """Return the words of a process's command, a null after each; empty for one that has ended."""
    with contextlib.suppress(OSError):
        return Path(f"/proc/{process}/cmdline").read_text(errors="replace")
    return ""
