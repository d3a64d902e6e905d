"""Collect the lines of a function that is compiled when a message class is first used."""

from __future__ import annotations

import struct
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from gazelle_ros.messages.base import Message
from gazelle_ros.messages.spec import MessageSpec


class GeneratedCode:
    """Lines of Python and the names they refer to.

    Args:
        names: The globals of the code; structs and classes are added to it under short names.
    """

    def __init__(self, names: dict[str, Any]) -> None:
        self.names = names
        self._lines: list[str] = []
        self._depth = 1
        self._variables = 0

    def line(self, text: str) -> None:
        """Add a line."""
        self._lines.append("    " * self._depth + text)

    @contextmanager
    def block(self, head: str) -> Iterator[None]:
        """Add a line that opens a block, and indent until the end of the ``with``."""
        self.line(head)
        self._depth += 1
        before = len(self._lines)
        yield
        if len(self._lines) == before:
            self.line("pass")
        self._depth -= 1

    def variable(self, kind: str = "v") -> str:
        """Return a fresh local name."""
        self._variables += 1
        return f"{kind}{self._variables}"

    def struct(self, codes: str, method: str) -> str:
        """Return the name of a method of the struct with these codes, little endian."""
        name = f"_{method}_{codes.replace('?', 'o')}"  # no struct code is an o
        if name not in self.names:
            self.names[name] = getattr(struct.Struct("<" + codes), method)
        return name

    def message_class(self, full_name: str, known: dict[str, type[Message]]) -> str:
        """Return the name of the class of a message type."""
        name = "_class_" + full_name.replace("/", "__")
        self.names.setdefault(name, known[full_name])
        return name

    def source(self, head: str) -> str:
        """Return the text of the function under this ``def`` line."""
        return "\n".join([head, *(self._lines or ["    pass"]), ""])


def fixed_codes(spec: MessageSpec, known: dict[str, type[Message]]) -> str | None:
    """Return struct codes of a message of constant size; otherwise ``None``.

    Arrays of fixed length count as not fixed, unless they are of octets.
    """
    from gazelle_ros.messages.spec import OCTETS, STRUCT_CODES

    codes = ""
    for field in spec.fields:
        if field.is_array:
            if field.base not in OCTETS or field.length is None:
                return None
            codes += f"{field.length}s"
        elif field.base == "time":
            codes += "II"
        elif field.base == "duration":
            codes += "ii"
        elif field.base == "string":
            return None
        elif field.is_message:
            inner = fixed_codes(known[field.base]._spec, known)
            if inner is None:
                return None
            codes += inner
        else:
            codes += STRUCT_CODES[field.base]
    return codes
