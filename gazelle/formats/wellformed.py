"""XML that is not well-formed, made so where Gazebo's parsers (TinyXML and TinyXML-2) continue.

``--`` in comments, misspelt or misplaced declarations, attributes without quotes or twice, ``&``
by itself, bytes that are not UTF-8, and anything behind the end of the root element. Lines keep
their numbers. Elements that do not close in their order are refused by Gazebo too.
"""

from __future__ import annotations

import re
from bisect import bisect_left
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import NamedTuple

_CURLY = "\u201c\u201d\u2018\u2019"
_DECLARATION = re.compile(
    r"""<\?xml\s+version\s*=\s*("[\w.:-]+"|'[\w.:-]+')"""
    r"""(\s+[\w.-]+\s*=\s*("[^"]*"|'[^']*'))*\s*\?>"""
)
_ENCODING = re.compile(rb"""\A[\s\xef\xbb\xbf]*<\?xml[^>]*?encoding\s*=\s*["']([\w.-]*)["']""")
_NAMES_ENCODING = re.compile(r"""\s+encoding\s*=\s*("[^"]*"|'[^']*')""")
_ASCII_BASED = ("ascii", "cp125", "iso-8859", "iso8859", "latin", "us-ascii", "utf-8", "utf8")
_ENTITY = re.compile(r"&(?!(?:lt|gt|amp|quot|apos|#\d+|#x[0-9a-fA-F]+);)")
_CONTROL = re.compile(r"[\x00-\x08\x0b\x0c\x0e-\x1f]")
# quantifiers with an end that never give back, so that no file can make the search slow
_TAG = re.compile(r"""<(/?)([^\s<>/="']++)((?:"[^"]*+"|'[^']*+'|[^"'>]){0,20000}+)>""")
_BARE = rf"[^\s\"'<>/{_CURLY}]"
_ATTRIBUTE = re.compile(
    rf"""\s*([^\s=/"'<>{_CURLY}]+)\s*=\s*("[^"]*"|'[^']*'|{_BARE}+(?:/(?!\s*$){_BARE}*)*)"""
)


@dataclass(slots=True)
class _Mending:
    """Text under repair for well-formedness.

    Attributes:
        text: As it is in the file.
        parts: The well-formed text so far.
        found: Places and what was wrong there.
    """

    text: str
    parts: list[str] = field(default_factory=list)
    found: list[tuple[int, str]] = field(default_factory=list)

    def fault(self, at: int, message: str) -> None:
        self.found.append((at, message))

    def done(self, rest: str = "") -> tuple[str, list[tuple[int, str]]]:
        """Return the text, and the lines of faults."""
        ends = [found.start() for found in re.finditer("\n", self.text)]
        lines = [(bisect_left(ends, at) + 1, message) for at, message in self.found]
        return "".join([*self.parts, rest]), lines

    def put(self, old: str, new: str, at: int, message: str) -> None:
        """Append a replacement, and report it if it differs."""
        if new != old:
            self.fault(at, message)
        self.parts.append(new)


def well_formed(data: bytes) -> tuple[str, list[tuple[int, str]]] | None:
    """Return a file's text made well-formed, with its faults and their lines.

    None where the file is in no encoding that ASCII is a part of; there may still be faults left.
    """
    decoded = _decoded(data)
    if decoded is None:
        return None
    text, wrong = decoded
    work = _Mending(text)
    if wrong is not None:
        work.fault(*wrong)
    at, depth = 0, 0
    for start, end, kind in _pieces(text):
        _characters(work, text[at:start], at)
        piece = text[start:end]
        if kind is not None:
            kind.put(work, piece, start)
        else:
            depth += _tag(work, piece, start)
        at = end
        if depth <= 0 and kind is None:
            _behind(work, at)
            return work.done()
    return work.done(text[at:])


class _Kind(NamedTuple):
    """Construct that begins with ``<`` and is no tag: its end, and the function that copies it."""

    closing: str
    put: Callable[[_Mending, str, int], None]


def _decoded(data: bytes) -> tuple[str, tuple[int, str] | None] | None:
    """Return the text, and the place where it is not in the file's encoding."""
    named = _ENCODING.match(data)
    encoding = named[1].decode("ascii", "replace").lower() if named else "utf-8"
    if data[:2] in {b"\xff\xfe", b"\xfe\xff"} or not encoding.startswith(_ASCII_BASED):
        return None
    try:
        return data.decode(encoding), None
    except (LookupError, UnicodeDecodeError) as error:
        at = error.start if isinstance(error, UnicodeDecodeError) else 0
        text = data.decode("latin-1")
        return text, (at, f"the text is not in {encoding}: Latin-1 was taken")


def _pieces(text: str) -> Iterator[tuple[int, int, _Kind | None]]:
    """Yield comments, declarations and the like, and tags (no kind), in order."""
    at = 0
    while (start := text.find("<", at)) >= 0:
        kind = next((kind for opening, kind in _KINDS if text.startswith(opening, start)), None)
        if kind is None:
            tag = _TAG.match(text, start)
            at = start + 1 if tag is None else tag.end()
        else:
            end = text.find(kind.closing, start)
            tag, at = None, end + len(kind.closing)
            if end < 0:
                return
        if kind is not None or tag is not None:
            yield start, at, kind


def _comment(work: _Mending, piece: str, at: int) -> None:
    inner = piece[4:-3]
    if "--" in inner or inner.endswith("-"):
        inner = inner.replace("-", " ")
    new = f"<!--{_CONTROL.sub(' ', inner)}-->"
    work.put(piece, new, at, "a comment must hold no '--' and no control character")


def _whole(work: _Mending, piece: str, _: int) -> None:
    work.parts.append(piece)


def _instruction(work: _Mending, piece: str, at: int) -> None:
    if not piece.startswith("<?xml") or piece[5:6].isalnum() or piece[5:6] == "-":
        work.parts.append(piece)
    elif not _DECLARATION.fullmatch(piece):
        work.put(piece, "\n" * piece.count("\n"), at, f"'{piece}' is not an XML declaration")
    elif "".join(work.parts).strip("\ufeff \t\r\n"):
        work.put(piece, "\n" * piece.count("\n"), at, "the XML declaration must come first")
    else:
        # the text is encoded again, so its declared encoding may no longer hold
        work.parts.append(_NAMES_ENCODING.sub("", piece))


_KINDS = (
    ("<!--", _Kind("-->", _comment)),
    ("<![CDATA[", _Kind("]]>", _whole)),
    ("<!", _Kind(">", _whole)),
    ("<?", _Kind("?>", _instruction)),
)


def _characters(work: _Mending, text: str, at: int) -> None:
    new = _CONTROL.sub(" ", _ENTITY.sub("&amp;", text))
    work.put(text, new, at, "'&' and control characters cannot stand in text")


def _tag(work: _Mending, piece: str, at: int) -> int:
    """Append a tag; returns by how much it changes the depth."""
    match = _TAG.fullmatch(piece)
    if match is None or match[1]:
        work.parts.append(piece)
        return -1 if match else 0
    rest = match[3]
    ends = rest.rstrip().endswith("/")
    new = _attributes(rest)
    if new is not None:
        attributes, message = new
        text = f"<{match[2]}{attributes}{'/' if ends else ''}>" if message else piece
        work.put(piece, text, at, message)
    else:
        work.parts.append(piece)
    return 0 if ends else 1


def _attributes(text: str) -> tuple[str, str] | None:
    """Return the repaired attributes of a tag and a message about the repair.

    None if the text is not a list of attributes.
    """
    inner = text.rstrip()
    inner = inner.removesuffix("/")
    parts, names, wrong, at = [], set(), "", 0
    for match in _ATTRIBUTE.finditer(inner):
        if inner[at : match.start()].strip():
            return None
        name, value = match[1], match[2]
        if at and match.start() == at and not match[0][:1].isspace():
            wrong = wrong or f"a blank must stand before the attribute '{name}'"
        at = match.end()
        if value[0] not in "\"'":
            wrong = wrong or f"the value of the attribute '{name}' must stand in quotes"
            value = f'"{value}"'
        clean = _CONTROL.sub(" ", _ENTITY.sub("&amp;", value)).replace("<", "&lt;")
        if clean != value:
            wrong = wrong or f"'&' and '<' cannot stand in the attribute '{name}'"
        if name in names:
            wrong = wrong or f"there is already an attribute '{name}': the first was taken"
            parts.append("\n" * match[0].count("\n"))
            continue
        names.add(name)
        blank = match[0][: len(match[0]) - len(match[0].lstrip())] or " "
        parts.append(f"{blank}{name}={clean}")
    if inner[at:].strip():
        return None
    return "".join(parts) + inner[at:], wrong


def _behind(work: _Mending, at: int) -> None:
    """Remove and report content after the root element."""
    rest = re.sub(r"<!--.*?-->", "", work.text[at:], flags=re.DOTALL)
    if rest.strip("\x00 \t\r\n"):
        work.fault(
            at + len(work.text[at:]) - len(work.text[at:].lstrip()),
            "behind the end of the root element there is more, which was left out",
        )
