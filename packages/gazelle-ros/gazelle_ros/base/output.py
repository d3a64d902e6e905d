"""Text for the standard output that is seen at once, also where it is a file or a pipe."""

from __future__ import annotations

import sys


def say(text: str) -> None:
    """Write text."""
    sys.stdout.write(text)
    sys.stdout.flush()


def say_line(text: str) -> None:
    """Write text and the end of a line."""
    say(f"{text}\n")
