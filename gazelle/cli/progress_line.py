"""Line on standard error that shows how far long work is."""

from __future__ import annotations

import sys
import threading
import time
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from typing import TypeVar

_FIRST = 2.0  # shorter work shows nothing [s]
_ANNOUNCED = 0.6  # work of unknown length that takes longer is announced [s]
_EVERY = 0.5  # on a terminal, where the line is rewritten [s]
_LINE_EVERY = 10.0  # elsewhere, where each is a line of a log [s]

Item = TypeVar("Item")


class ProgressLine:
    """Shows counts after two seconds of work: rewritten in place on a terminal.

    Args:
        text: The work, such as ``filming``.
        total: Count at the end; None if unknown.
        unit: Noun for the count.
    """

    def __init__(self, text: str, total: int | None = None, unit: str = "") -> None:
        self._text, self._total, self._unit = text, total, unit
        self._live = sys.stderr.isatty()
        self._next = time.monotonic() + _FIRST
        self._shown = False

    def update(self, done: int) -> None:
        """Show the count if it is time to."""
        now = time.monotonic()
        if now < self._next:
            return
        self._next = now + (_EVERY if self._live else _LINE_EVERY)
        self._shown = True
        count = f"{done:,}" if self._total is None else f"{done:,} of {self._total:,}"
        line = f"{self._text}: {count} {self._unit}".rstrip()
        sys.stderr.write(f"\r{line:<60}" if self._live else f"{line}\n")
        sys.stderr.flush()

    def close(self) -> None:
        """Remove the line from a terminal."""
        if self._live and self._shown:
            sys.stderr.write(f"\r{'':<60}\r")
            sys.stderr.flush()

    def count(self, items: Iterable[Item]) -> Iterator[Item]:
        """Yield items, and show how many there were."""
        try:
            for number, item in enumerate(items, 1):
                yield item
                self.update(number)
        finally:
            self.close()


@contextmanager
def announced(text: str) -> Iterator[None]:
    """Print a line on standard error if what is done meanwhile takes more than a moment.

    Args:
        text: The work, such as ``loading robot.urdf``.
    """
    timer = threading.Timer(_ANNOUNCED, sys.stderr.write, [f"gazelle: {text}\n"])
    timer.daemon = True
    timer.start()
    try:
        yield
    finally:
        timer.cancel()
