"""Explanations of text that is not well-formed XML, for files written by hand.

Expat names what it met and where; this says which element is open there, since which line, and
what to write.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from xml.parsers import expat

_NAME = re.compile(rb"[^\s<>/=]+")
_TAG_OPEN = re.compile(rb"<[^<>]*\Z")
_LONGEST = 10_000
"""Number of bytes before a fault that are examined."""

_MISMATCH, _INVALID, _NO_ELEMENT = (
    expat.errors.codes[message]
    for message in (
        expat.errors.XML_ERROR_TAG_MISMATCH,
        expat.errors.XML_ERROR_INVALID_TOKEN,
        expat.errors.XML_ERROR_NO_ELEMENTS,
    )
)


@dataclass(frozen=True, slots=True)
class Opened:
    """An element that is open at the fault.

    Attributes:
        tag: Its tag.
        line: Its first line, from 1.
    """

    tag: str
    line: int


def explained(code: int, data: bytes, at: int, opened: Sequence[Opened]) -> tuple[str, str | None]:
    """Return the message for a fault, and a hint.

    Args:
        code: Expat's code.
        data: The text.
        at: Offset of the fault [bytes].
        opened: The elements that are open there, outermost first.
    """
    reason = expat.ErrorString(code)
    if code == _MISMATCH and opened:
        return _mismatch(reason, data, at, opened)
    if code == _NO_ELEMENT and opened:
        inner = opened[-1]
        return (
            f"{reason}: the file ends, and <{inner.tag}> of line {inner.line} is not closed",
            f"</{inner.tag}> is missing",
        )
    if code == _INVALID and data[at : at + 1] == b"<":
        return _quote(reason, data, at)
    return reason, None


def _mismatch(
    reason: str, data: bytes, at: int, opened: Sequence[Opened]
) -> tuple[str, str | None]:
    found = _NAME.match(data, at)
    if found is None:  # the text is in no encoding that ASCII is a part of
        return reason, None
    tag = found[0].decode(errors="replace")
    inner = opened[-1]
    if any(each.tag == tag for each in opened[:-1]):
        return (
            f"{reason}: </{tag}> stands where <{inner.tag}> of line {inner.line} is still open",
            f"</{inner.tag}> is missing before it",
        )
    return (
        f"{reason}: </{tag}> closes nothing; open is <{inner.tag}> of line {inner.line}",
        f"write </{inner.tag}>, or take </{tag}> out",
    )


def _quote(reason: str, data: bytes, at: int) -> tuple[str, str | None]:
    """Return the message for a ``<`` within a tag: a quote that is not closed, or a tag."""
    before = _TAG_OPEN.search(data[max(0, at - _LONGEST) : at].replace(b">", b" "))
    if before is None:
        return reason, None
    line = data.count(b"\n", 0, at - len(before[0])) + 1
    return f"{reason}: '<' stands in a tag that begins in line {line}", (
        "close its quote, or write &lt; for '<'"
    )
