"""Elements as XML text."""

from __future__ import annotations

import re
from collections.abc import Iterator
from xml.sax.saxutils import escape

from gazelle.description import Parameters
from gazelle.errors import FormatError
from gazelle_ros.base import characters

_NAME = re.compile(r"[^\W\d][\w.:-]*")
_ILLEGAL = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
# raw, a reader takes these for blanks that came with text from a web page
_UNUSUAL = {character: f"&#{ord(character)};" for character in characters.UNUSUAL}
_IN_TEXT = {"\r": "&#13;", **_UNUSUAL}
_IN_ATTRIBUTE = {**_IN_TEXT, "\n": "&#10;", "\t": "&#9;", '"': "&quot;"}
_DECLARED = {"xml", "xmlns"}


def document(root: Parameters) -> str:
    """Return a whole XML file; undeclared prefixes are declared in the root.

    Raises:
        FormatError: A name or text cannot stand in XML.
    """
    used = sorted(set(_prefixes(root)) - _DECLARED)
    extra = {f"xmlns:{prefix}": f"urn:{prefix}" for prefix in used}
    return '<?xml version="1.0"?>\n' + "".join(_lines(root, "", extra))


def fragment(node: Parameters, indent: str = "") -> str:
    """Return the text of one element, two blanks a level, with a line break at its end.

    Raises:
        FormatError: As ``document``.
    """
    return "".join(_lines(node, indent, {}))


def _prefixes(node: Parameters) -> Iterator[str]:
    waiting = [node]
    while waiting:
        current = waiting.pop()
        declared = {name.removeprefix("xmlns:") for name in current.attributes}
        for name in (current.tag, *current.attributes):
            prefix, separator, _ = name.partition(":")
            if separator and prefix not in declared:
                yield prefix
        waiting.extend(current.children)


def _lines(node: Parameters, indent: str, extra: dict[str, str]) -> Iterator[str]:
    attributes = {**extra, **node.attributes}
    shown = "".join(
        f' {_name(name, node)}="{_escaped(text, node, _IN_ATTRIBUTE)}"'
        for name, text in attributes.items()
    )
    start = f"{indent}<{_name(node.tag, node)}{shown}"
    text = _escaped(node.text, node, _IN_TEXT)
    if not node.children:
        yield f"{start}>{text}</{node.tag}>\n" if text else f"{start}/>\n"
        return
    yield f"{start}>{text}\n"
    for child in node.children:
        yield from _lines(child, indent + "  ", {})
    yield f"{indent}</{node.tag}>\n"


def _name(name: str, node: Parameters) -> str:
    if not _NAME.fullmatch(name):
        raise FormatError(f"'{name}' cannot be a name in XML", source=node.source)
    return name


def _escaped(text: str, node: Parameters, special: dict[str, str]) -> str:
    bad = _ILLEGAL.search(text)
    if bad:
        raise FormatError(
            f"the character {bad.group()!r} of '{text[:40]}' cannot stand in XML",
            source=node.source,
            element=node.tag,
        )
    return escape(text, special)
