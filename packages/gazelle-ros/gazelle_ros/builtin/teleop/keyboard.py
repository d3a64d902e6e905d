"""Keys as they are pressed, from the terminal of this process."""

from __future__ import annotations

import contextlib
import os
import re
import select
import signal
import sys
import threading
from types import TracebackType
from typing import Any, Self

from gazelle_ros.base.errors import RosError

CTRL_C = "\x03"
UP, DOWN, RIGHT, LEFT = "\x1b[A", "\x1b[B", "\x1b[C", "\x1b[D"
_KEY = re.compile("\x1b\\[[0-9;]*[A-Za-z~]|\x1bO[A-Za-z]|.", re.DOTALL)
"""A key is one character, or what a terminal sends for an arrow and its like."""


class Keyboard:
    """The keys of the terminal, without waiting for the end of a line; use it with ``with``.

    Afterwards the terminal is as it was. Ctrl-C and Ctrl-Z continue to do what they do.

    Raises:
        RosError: Standard input is not a terminal.
    """

    def __init__(self) -> None:
        if sys.stdin is None or not sys.stdin.isatty():
            raise RosError(
                "standard input is not a terminal, from which keys are read",
                hint="start it in a terminal, not in the background and not in a pipe",
            )
        self._number = sys.stdin.fileno()
        self._before: list[Any] = []

    def __enter__(self) -> Self:
        import termios  # there is none on Windows

        self._before = termios.tcgetattr(self._number)
        self._listen()
        if threading.current_thread() is threading.main_thread():
            signal.signal(signal.SIGCONT, lambda *_: self._listen())
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        import termios

        if threading.current_thread() is threading.main_thread():
            signal.signal(signal.SIGCONT, signal.SIG_DFL)
        with contextlib.suppress(termios.error):  # it was closed
            termios.tcsetattr(self._number, termios.TCSANOW, self._before)

    def wait(self, seconds: float) -> list[str] | None:
        """Return the keys pressed since the last time, waited for at most so long.

        Returns:
            Characters, or what the terminal sends for other keys, such as `UP`; None when the
            terminal is gone.
        """
        ready, _, _ = select.select([self._number], [], [], seconds)
        if not ready:
            return []
        try:
            data = os.read(self._number, 256)
        except OSError:
            return None
        return _KEY.findall(data.decode(errors="replace")) if data else None

    def _listen(self) -> None:
        """Set the terminal to deliver keys at once, without echo."""
        import termios

        mode = [*self._before]
        mode[3] &= ~(termios.ICANON | termios.ECHO)
        mode[6] = [*mode[6]]
        mode[6][termios.VMIN], mode[6][termios.VTIME] = 1, 0
        termios.tcsetattr(self._number, termios.TCSANOW, mode)
