"""Joysticks by Linux's joystick interface (https://www.kernel.org/doc/html/latest/input/joydev)."""

from __future__ import annotations

import os
import select
import struct
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import Self

FOLDER = Path("/dev/input")
_EVENT = struct.Struct("IhBB")
_BUTTON, _AXIS, _INITIAL = 0x01, 0x02, 0x80
_NAME_BYTES = 128
_READ_NAME = 0x80006A13 | _NAME_BYTES << 16
"""JSIOCGNAME of ``linux/joystick.h``."""
_MOST_EVENTS = 64


@dataclass(frozen=True, slots=True)
class JoystickEvent:
    """A change of an axis or of a button.

    Attributes:
        number: Of the axis or the button.
        value: -32767 to 32767 of an axis, 0 or 1 of a button.
        is_axis: Whether it is an axis.
        is_initial: Whether it reports the initial state.
    """

    number: int
    value: int
    is_axis: bool
    is_initial: bool


class LinuxJoystick:
    """An open joystick; use it with ``with``.

    Args:
        path: Its device, such as ``/dev/input/js0``.

    Attributes:
        name: Name of the program.

    Raises:
        OSError: It is not there, or may not be read.
    """

    def __init__(self, path: str) -> None:
        self._number = os.open(path, os.O_RDONLY | os.O_NONBLOCK)
        self.name = _name_of(self._number)
        self._rest = b""

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        os.close(self._number)

    def wait(self, seconds: float) -> list[JoystickEvent]:
        """Return events, waited for at most so long.

        Raises:
            OSError: The joystick is gone.
        """
        ready, _, _ = select.select([self._number], [], [], max(0.0, seconds))
        if not ready:
            return []
        data = os.read(self._number, _EVENT.size * _MOST_EVENTS)
        if not data:
            raise OSError("it sends no more data")
        return list(self._decoded(data))

    def _decoded(self, data: bytes) -> Iterator[JoystickEvent]:
        data = self._rest + data
        whole = len(data) - len(data) % _EVENT.size
        self._rest = data[whole:]
        for _time, value, kind, number in _EVENT.iter_unpack(data[:whole]):
            if kind & ~_INITIAL in {_AXIS, _BUTTON}:
                yield JoystickEvent(
                    number, value, bool(kind & _AXIS), is_initial=bool(kind & _INITIAL)
                )


def joysticks() -> dict[str, str]:
    """Return the names of this machine's joysticks that can be read, by their devices."""
    found = {}
    for path in sorted(FOLDER.glob("js*")):
        try:
            with LinuxJoystick(str(path)) as each:
                found[str(path)] = each.name
        except OSError:
            continue
    return found


def _name_of(number: int) -> str:
    import fcntl  # there is none on Windows

    buffer = bytearray(_NAME_BYTES)
    try:
        fcntl.ioctl(number, _READ_NAME, buffer)
    except OSError:
        return "Unknown"
    return buffer.split(b"\0", 1)[0].decode(errors="replace")
