"""Name of this process in the system, for scripts that end it by ``killall gzserver``."""

from __future__ import annotations

import contextlib
from pathlib import Path


def call_process(name: str | None) -> None:
    """Set the process's name for ``ps`` and ``killall`` (Linux: its first 15 letters).

    Elsewhere they know it by its command line only, in which the name is, too.
    """
    if name is None:
        return
    with contextlib.suppress(OSError):
        Path("/proc/self/comm").write_text(name, encoding="utf-8")
