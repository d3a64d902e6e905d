"""Special characters in text copied from web pages and word processors."""

from __future__ import annotations

import re

MESSAGE = "there is a no-break space or another unusual blank, which was taken as a space"

_WIDE = "\u00a0\u1680" + "".join(map(chr, range(0x2000, 0x200B))) + "\u202f\u205f\u3000"
_WITHOUT_WIDTH = "\u200b\u2060\ufeff"

UNUSUAL = _WIDE + _WITHOUT_WIDTH
"""Blanks that are not typed."""

XML_COMMENT = re.compile("<!--.*?-->", re.DOTALL)
"""Pattern of a comment in XML."""

_BYTES = tuple(blank.encode() for blank in UNUSUAL)

_BLANK = re.compile(f"[{_WIDE}]")
_NOTHING = re.compile(f"(?<!\\A)[{_WITHOUT_WIDTH}]")
_CURLY = re.compile("[\u2018-\u201f]")


_IMPOSSIBLE = re.compile("[\0\ud800-\udfff]")


def can_be_written(text: str) -> bool:
    """Return False for a text with a null or with half of a surrogate pair, which no file or name holds."""
    return _IMPOSSIBLE.search(text) is None


def plain_bytes(data: bytes, comment: re.Pattern[str]) -> tuple[bytes, int | None]:
    """Return the same as ``plain`` for a file's bytes, unchanged if they are not UTF-8."""
    if all(blank not in data for blank in _BYTES):
        return data, None
    try:
        text = data.decode()
    except UnicodeDecodeError:  # another encoding, in which those bytes are something else
        return data, None
    clean, line = plain(text, comment)
    return clean.encode(), line


def plain(text: str, comment: re.Pattern[str]) -> tuple[str, int | None]:
    """Return text with plain blanks, and the line of the first other one outside of comments.

    Blanks without width are taken out.
    """
    clean = _NOTHING.sub("", _BLANK.sub(" ", text))
    if clean == text:
        return text, None
    said = comment.sub(lambda found: "\n" * found[0].count("\n"), text)
    at = min((found.start() for p in (_BLANK, _NOTHING) if (found := p.search(said))), default=None)
    return clean, None if at is None else said.count("\n", 0, at) + 1


def curly_hint(text: str) -> str | None:
    """Return a hint for a curly quote in a text; None where there is none."""
    found = _CURLY.search(text)
    return f"{found[0]} is a curly quote: write a straight one, \" or '" if found else None
