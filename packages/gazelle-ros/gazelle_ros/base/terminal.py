"""Settings of the terminal that a program runs in."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Iterator
from typing import TextIO


@contextlib.contextmanager
def kept_terminal(stream: TextIO | None) -> Iterator[bool]:
    """Restore the settings of a terminal at the end, if it is still open then.

    Yields whether the stream is a terminal.
    """
    if stream is None or not stream.isatty() or os.name != "posix":
        yield False
        return
    import termios  # there is none on Windows

    before = termios.tcgetattr(stream)
    try:
        yield True
    finally:
        with contextlib.suppress(termios.error):
            termios.tcsetattr(stream, termios.TCSANOW, before)
