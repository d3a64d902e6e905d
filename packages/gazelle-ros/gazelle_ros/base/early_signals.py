"""Ctrl-C while a program is being imported."""

from __future__ import annotations

import contextlib
import importlib
import signal
from collections.abc import Iterator


def run_program(module: str) -> int:
    """Import a module and call its ``main``; returns the exit code, also of Ctrl-C before or after."""
    try:
        with _ending_quietly():
            main = importlib.import_module(module).main
        return int(main())
    except KeyboardInterrupt:
        return 130


@contextlib.contextmanager
def _ending_quietly() -> Iterator[None]:
    """Make Ctrl-C end the process without a traceback, while it lasts; for programs' main threads."""
    before = signal.getsignal(signal.SIGINT)
    if before is signal.default_int_handler:  # it is ignored in a shell's background job
        signal.signal(signal.SIGINT, signal.SIG_DFL)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)
