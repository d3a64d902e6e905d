"""Operations of Python expressions on texts, kept from making much."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from typing import Any

from gazelle_ros.base.errors import FormatError

MAX_LENGTH = 100_000
"""Items of a list and characters of a text that an operation makes."""

MAX_MADE = 10_000_000
"""Items of all lists and texts that the expressions of a file make."""

MAX_WIDTH = 1_000
"""Characters that a text is padded to."""

MAX_TEXT = 4_000_000
"""Characters of a text that other texts are put into."""

_WIDE = re.compile(r"\d{4,}|\*|\{")
_WIDE_PERCENT = re.compile(r"%[^%a-zA-Z]*(\d{4,}|\*)")
_WIDE_FORMAT = re.compile(r"\{[^{}]*:[^{}]*(\d{4,}|\{)")
_PADS = {"center", "expandtabs", "ljust", "rjust", "zfill"}
_GROWS = {"format", "format_map", "join", "replace", "translate"}

_CONVERSIONS: dict[str, Callable[[Any], str]] = {"s": str, "r": repr, "a": ascii}

METHODS = _PADS | _GROWS
"""Names of methods that ``call`` checks."""


def check_length(length: int) -> None:
    """Check a number of items that an operation makes.

    Raises:
        FormatError: They are too many.
    """
    if length > MAX_LENGTH:
        raise FormatError(f"the expression makes more than {MAX_LENGTH} items")


def width(value: Any) -> Any:
    """Return a width that text is padded to.

    Raises:
        FormatError: It is too large.
    """
    if isinstance(value, int) and value > MAX_WIDTH:
        raise FormatError(f"text may be padded to {MAX_WIDTH} characters at most")
    return value


def text(value: Any = "") -> str:
    """Return ``str`` of a value; lists that hold one list often are counted as they are written.

    Raises:
        FormatError: It is too long.
    """
    if not isinstance(value, str):
        check_written([value])
    return str(value)


def formatted(value: Any, conversion: int, spec: str) -> str:
    """Return a value as an f-string writes it.

    Raises:
        FormatError: It is too long.
    """
    check_written([value])
    _check_widths(_WIDE, spec)
    if conversion != -1:
        value = _CONVERSIONS[chr(conversion)](value)
    return format(value, spec)


def percent(left: Any, right: Any) -> Any:
    """Return a remainder, or a text with values.

    Raises:
        FormatError: The text is too long.
    """
    if isinstance(left, bytes):
        raise FormatError("bytes are no text: '%' cannot put values into them")
    if isinstance(left, str):
        _check_widths(_WIDE_PERCENT, left)
        check_written([right] * (left.count("%(") or 1))
    return left % right


def call(owner: Any, name: str, *values: Any, **named: Any) -> Any:
    """Return the result of a method, which of texts makes no long ones.

    Raises:
        FormatError: It is too long.
    """
    if isinstance(owner, str | bytes):
        if name in _PADS:
            values = tuple(map(width, values))
            if name == "expandtabs":
                _check_letters(len(owner) * (values[0] if values else 8))
        elif name == "join":
            values = (list(values[0]), *values[1:]) if values else values
            parts = values[0] if values else []
            _check_letters(len(owner) * len(parts) + sum(map(_letters, parts)))
        elif name == "replace" and len(values) > 1:
            _check_letters(owner.count(values[0]) * _letters(values[1]) + len(owner))
        elif name == "translate":
            table = values[0] if values and isinstance(values[0], Mapping) else {}
            _check_letters(len(owner) * max([1, *map(_letters, table.values())]))
        elif isinstance(owner, str):
            _check_widths(_WIDE_FORMAT, owner)
            check_written([*values, *named.values()] * max(1, owner.count("{")))
    return getattr(owner, name)(*values, **named)


def _check_widths(wide: re.Pattern[str], spec: str) -> None:
    if wide.search(spec):
        raise FormatError(f"text may be padded to {MAX_WIDTH - 1} characters at most")


def _check_letters(count: int) -> None:
    if count > MAX_TEXT:
        raise FormatError(f"the expression makes more than {MAX_TEXT:,} characters")


def _letters(value: Any) -> int:
    return len(value) if isinstance(value, str | bytes) else 1


def check_written(values: list[Any]) -> None:
    """Check how much values would be as text, what is in two lists counted twice.

    Raises:
        FormatError: They are too much.
    """
    left, letters = MAX_LENGTH, 0
    waiting: list[Iterator[Any]] = [iter(values)]
    while waiting:
        value = next(waiting[-1], waiting)
        if value is waiting:
            waiting.pop()
            continue
        left -= 1
        letters += _letters(value)
        _check_letters(letters)
        if left < 0 or len(waiting) > MAX_WIDTH:
            raise FormatError(f"the expression makes more than {MAX_LENGTH} items")
        if isinstance(value, Mapping):
            waiting.append(iter((*value.keys(), *value.values())))
        elif isinstance(value, list | tuple | set | frozenset):
            waiting.append(iter(value))
