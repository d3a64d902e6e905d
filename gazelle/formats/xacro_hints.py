"""Hints for the most common mistakes in xacro files."""

from __future__ import annotations

import re
from collections.abc import Iterator
from types import TracebackType
from typing import Any

from gazelle.errors import closest_of

_ARGUMENT = re.compile(r"Undefined substitution argument (\S+)")
_MACRO = re.compile(r"unknown macro name: xacro:(\S+)")
_NAME = re.compile(r"name '([^']+)' is not defined")


def hint_of(text: str, trace: TracebackType | None) -> str | None:
    """Return a hint on an error of the ``xacro`` package, or None.

    Args:
        text: The message.
        trace: The traceback: its functions know the macros and properties there are.
    """
    argument = _ARGUMENT.search(text)
    if argument is not None:
        name = argument[1]
        return (
            f"give it a value, xacro_args={{'{name}': ...}}, or a default: "
            f'<xacro:arg name="{name}" default="..."/>'
        )
    for pattern, variable in ((_MACRO, "macros"), (_NAME, "symbols")):
        found = pattern.search(text)
        if found is not None:
            return closest_of(found[1], {*_names(trace, variable)})
    return None


def _names(trace: TracebackType | None, variable: str) -> Iterator[str]:
    """Yield the keys of the tables of that name in the functions that were running."""
    while trace is not None:
        table: Any = trace.tb_frame.f_locals.get(variable)
        while isinstance(table, dict):
            yield from (key for key in table if isinstance(key, str))
            table = getattr(table, "parent", None)
        trace = trace.tb_next
