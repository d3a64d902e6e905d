"""Messages as text: as YAML with parts left out, and as lines of comma-separated values."""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterable
from typing import Any

from gazelle_ros.messages import Message
from gazelle_ros.messages.yaml import strify_message
from gazelle_ros.time import Time, TVal

Transform = Callable[[Any, str | None], Any]


def leave_out(*, strings: bool, arrays: bool) -> Transform:
    """Return a function that replaces strings and arrays of a message by notes.

    It takes a value and its type, None for a whole message.
    """

    def note(value: Any, kind: str) -> Any:
        if arrays and "[" in kind:
            return f"<array type: {kind.partition('[')[0]}, length: {len(value)}>"
        if strings and kind == "string":
            return f"<string length: {len(value)}>"
        if strings and kind.startswith("string["):
            return f"<array type: string, length: {len(value)}>"
        return value

    def transform(value: Any, kind: str | None) -> Any:
        if not isinstance(value, Message):
            return value if kind is None else note(value, kind)
        kinds, values = [], []
        for name, each in zip(value.__slots__, value._slot_types, strict=True):
            old = getattr(value, name)
            new = transform(old, None) if isinstance(old, Message) else note(old, each)
            kinds.append("string" if isinstance(new, str) else each)
            values.append(new)
        shown = _shown_class(tuple(value.__slots__), tuple(kinds))
        made = shown.__new__(shown)
        for name, each in zip(value.__slots__, values, strict=True):
            setattr(made, name, each)
        return made

    return transform


@functools.lru_cache(maxsize=256)
def _shown_class(names: tuple[str, ...], kinds: tuple[str, ...]) -> type[Message]:
    """Return a message class with these fields, for showing only."""
    return type("Shown", (Message,), {"__slots__": list(names), "_slot_types": list(kinds)})


def as_yaml(value: Any, *, offset: Time | None = None, width: int | None = None) -> str:
    """Return a value as ``rostopic echo`` prints it."""
    text = strify_message(value, time_offset=offset, fixed_numeric_width=width)
    return str(text)


def shown_fields(message: Message, *, strings: bool, arrays: bool) -> Iterable[str]:
    """Yield names of the fields that are plotted."""
    for name, kind in zip(message.__slots__, message._slot_types, strict=True):
        if not (arrays and "[" in kind) and not (strings and "string" in kind):
            yield name


class Plot:
    """Messages as comma-separated values, for plotting programs.

    Args:
        strings: Leave out strings.
        arrays: Leave out arrays.
    """

    def __init__(self, *, strings: bool = False, arrays: bool = False) -> None:
        self._strings = strings
        self._arrays = arrays

    def header(self, value: Any) -> str:
        """Return the names of the columns."""
        return "%time," + ",".join(name for name, _ in self._cells(value, "field"))

    def line(self, value: Any, stamp: Time, *, offset: Time | None = None) -> str:
        """Return one message as a line; its own stamp precedes the one given."""
        header = getattr(value, "header", None) if getattr(value, "_has_header", False) else None
        when = header.stamp if header is not None else stamp
        begin = offset.to_nsec() if offset is not None else 0
        cells = ",".join(_cell(each, offset) for _, each in self._cells(value, "field"))
        return f"{when.to_nsec() - begin},{cells}"

    def _cells(self, value: Any, name: str) -> Iterable[tuple[str, Any]]:
        """Yield columns and their values, in order."""
        if isinstance(value, Message):
            shown = set(shown_fields(value, strings=self._strings, arrays=self._arrays))
            for field, kind in zip(value.__slots__, value._slot_types, strict=True):
                if field in shown:
                    inner = getattr(value, field)
                    octets = isinstance(inner, bytes) and kind.startswith("uint8[")
                    yield from self._cells(list(inner) if octets else inner, f"{name}.{field}")
        elif isinstance(value, (list, tuple)):
            for number, each in enumerate(value):
                if not isinstance(each, (list, tuple)):
                    yield from self._cells(each, f"{name}{number}")
        elif isinstance(value, (bool, int, float, str, TVal)):
            yield name, value
        elif isinstance(value, bytes):
            yield name, value.decode("latin-1")


def _cell(value: Any, offset: Time | None) -> str:
    if isinstance(value, bool):
        return "1" if value else "0"
    if offset is not None and isinstance(value, Time):
        return str(value - offset)
    return str(value)
