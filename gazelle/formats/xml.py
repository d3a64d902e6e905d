"""XML files as trees of ``Parameters``, each element with its file and line.

Prefixes are kept in the names (``xacro:if``): robot files use them without declaring
them. Entities, document types and anything on the network are refused or ignored, and
size, depth and number of elements are limited, so that no file can exhaust the machine.
"""

from __future__ import annotations

import codecs
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from types import MappingProxyType
from xml.parsers import expat

from gazelle.description import Parameters, Source
from gazelle.errors import FormatError
from gazelle.formats import blanks
from gazelle.formats.blanks import Report
from gazelle.formats.lfs import refuse_pointer
from gazelle.formats.limits import (
    MAX_NAME,
    MAX_PLACE,
    MAX_XML_BYTES,
    MAX_XML_DEPTH,
    MAX_XML_ELEMENTS,
    LimitError,
    read_bounded,
)
from gazelle.formats.wellformed import well_formed
from gazelle.formats.xml_faults import Opened, explained
from gazelle_ros.base import characters

_NAMED = ("name", "reference", "filename")
_BLANK = b" \t\r\n\xef\xbb\xbf\xff\xfe\x00"
_FIRST = {b"<"}
_COMMENT = re.compile(rb"<!--.*?-->", re.DOTALL)
_NO_ATTRIBUTES: MappingProxyType[str, str] = MappingProxyType({})


def read_bytes(path: Path) -> bytes:
    """Read the content of a description file.

    Raises:
        FormatError: The file is missing, unreadable, a pointer of Git LFS, or larger than
            ``MAX_XML_BYTES``.
    """
    try:
        data = read_bounded(path, MAX_XML_BYTES)
    except FileNotFoundError:
        raise FormatError("there is no such file", file=str(path)) from None
    except (OSError, ValueError) as error:
        raise FormatError(f"the file cannot be read: {error}", file=str(path)) from error
    refuse_pointer(data, path)
    return data


def read_file(path: Path, report: Report | None = None) -> Parameters:
    """Read the root element of an XML file; ``report`` as for ``parse``.

    Raises:
        FormatError: The file cannot be read, or is not well-formed XML.
    """
    return parse(read_bytes(path), name=str(path), report=report)


def parse(text: str | bytes, *, name: str, report: Report | None = None) -> Parameters:
    """Return the root element of XML text.

    Args:
        text: The text, or its bytes.
        name: Stands for the file in errors.
        report: Takes what is wrong with text that is not well-formed and that Gazebo's parsers
            continue with; without it such text is an error.

    Raises:
        FormatError: The text is not well-formed XML, or exceeds a limit.
    """
    return parsed(text, name=name, report=report)[0]


def parsed(
    text: str | bytes, *, name: str, report: Report | None = None
) -> tuple[Parameters, bytes]:
    """Return the root element, and the well-formed text that it was read from; as ``parse``."""
    data = text.encode(errors="surrogatepass") if isinstance(text, str) else text
    if report is not None:
        data = blanks.plain_bytes(data, name, characters.XML_COMMENT, report)
    try:
        return _parsed(data, name, is_text=isinstance(text, str))
    except LimitError:
        raise
    except FormatError as error:
        mended = well_formed(data) if report is not None else None
        if report is None or mended is None:
            raise
        try:
            result = _parsed(mended[0].encode(), name, is_text=True)
        except FormatError:
            raise _with_quotes_named(error, data) from None
        for line, message in mended[1]:
            report(f"this is not well-formed XML: {message}", Source(name, line))
        return result


def _with_quotes_named(error: FormatError, data: bytes) -> FormatError:
    """Return the error, with a hint if it is of a line with a curly quote."""
    lines = data.decode(errors="replace").splitlines()
    at = (error.line or 1) - 1
    hint = characters.curly_hint(lines[at]) if at < len(lines) else None
    return FormatError(
        error.message,
        file=error.file,
        line=error.line,
        element=error.element,
        hint=hint or error.hint,
    )


def _parsed(data: bytes, name: str, *, is_text: bool) -> tuple[Parameters, bytes]:
    if len(data) > MAX_XML_BYTES:
        raise LimitError(f"the XML is larger than {MAX_XML_BYTES} bytes", file=name)
    if not data.strip():
        raise FormatError("the file is empty", file=name)
    if data.lstrip(_BLANK)[:1] not in _FIRST:
        raise FormatError("this is not XML: it does not begin with '<'", file=name, line=1)
    data = _declaration_first(data.removeprefix(codecs.BOM_UTF8))
    builder = _TreeBuilder(name, encoding="utf-8" if is_text else None)
    return builder.read(data), data


def _declaration_first(data: bytes) -> bytes:
    """Return the text with blanks and comments before the XML declaration moved behind it."""
    start = data.find(b"<?xml")
    if start <= 0 or _COMMENT.sub(b"", data[:start]).strip(_BLANK):
        return data
    end = data.find(b"?>", start) + 2
    return data[start:end] + data[:start] + data[end:] if end > 1 else data


@dataclass(slots=True)
class _Open:
    """An unclosed element."""

    tag: str
    attributes: dict[str, str]
    source: Source
    letters: int  # of its name and all around it
    text: list[str] = field(default_factory=list)
    children: list[Parameters] = field(default_factory=list)
    counts: dict[str, int] = field(default_factory=dict)


class _TreeBuilder:
    """Turns expat's events into a tree."""

    def __init__(self, name: str, encoding: str | None) -> None:
        self._name = name
        self._open: list[_Open] = []
        self._root: Parameters | None = None
        self._count = 0
        parser = self._parser = expat.ParserCreate(encoding)
        parser.buffer_text = True
        parser.StartElementHandler = self._start
        parser.EndElementHandler = self._end
        parser.CharacterDataHandler = self._characters
        parser.EntityDeclHandler = self._entity

    def read(self, data: bytes) -> Parameters:
        try:
            self._parser.Parse(data, True)
        except expat.ExpatError as error:
            opened = [Opened(each.tag, each.source.line or 1) for each in self._open]
            reason, hint = explained(error.code, data, self._parser.ErrorByteIndex, opened)
            raise FormatError(
                f"this is not well-formed XML: {reason}",
                file=self._name,
                line=error.lineno,
                element=self._open[-1].source.element if self._open else None,
                hint=hint,
            ) from None
        except (LookupError, ValueError) as error:
            raise FormatError(f"the encoding cannot be read: {error}", file=self._name) from None
        if self._root is None:
            raise FormatError("the file has no element", file=self._name)
        return self._root

    def _entity(self, entity: str, *_: object) -> None:
        raise FormatError(
            f"the file defines the entity '{entity}', which is not allowed",
            file=self._name,
            line=self._parser.CurrentLineNumber,
            hint="write its value where it is used",
        )

    def _start(self, tag: str, attributes: dict[str, str]) -> None:
        line = self._parser.CurrentLineNumber
        self._count += 1
        if len(self._open) >= MAX_XML_DEPTH or self._count > MAX_XML_ELEMENTS:
            what = (
                f"more than the limit of {MAX_XML_ELEMENTS:,} elements"
                if self._count > MAX_XML_ELEMENTS
                else f"elements nested more than {MAX_XML_DEPTH} deep"
            )
            raise LimitError(
                f"the file has {what}",
                file=self._name,
                line=line,
                element=self._open[-1].source.element if self._open else None,
                hint="make fewer and larger parts, such as one mesh of what never moves",
            )
        parent = self._open[-1] if self._open else None
        source = Source(self._name, line, _place(tag, attributes, parent))
        letters = refuse_long_name(attributes, source, parent.letters if parent else 0)
        self._open.append(_Open(tag, attributes, source, letters))

    def _characters(self, text: str) -> None:
        current = self._open[-1]
        if not current.children:
            current.text.append(text)

    def _end(self, _: str) -> None:
        done = self._open.pop()
        element = Parameters(
            done.tag,
            "".join(done.text).strip(),
            MappingProxyType(done.attributes) if done.attributes else _NO_ATTRIBUTES,
            tuple(done.children),
            done.source,
        )
        if self._open:
            self._open[-1].children.append(element)
        else:
            self._root = element


def _place(tag: str, attributes: dict[str, str], parent: _Open | None) -> str:
    """Return the path of an element.

    Steps are by name if there is one, else by number from the second on.
    """
    step = label(tag, attributes)
    if parent is None:
        return step
    if step == tag:
        number = parent.counts[tag] = parent.counts.get(tag, 0) + 1
        step = tag if number == 1 else f"{tag}[{number}]"
    return below(parent.source.element or "", step)


def below(outer: str, step: str) -> str:
    """Return the path of an element in another; of a long one the end."""
    return f"{outer if len(outer) <= 5 * MAX_PLACE else outer[-MAX_PLACE:]}/{step}"


def refuse_long_name(attributes: Mapping[str, str], source: Source, around: int = 0) -> int:
    """Return the number of characters of a name and of those around it.

    Raises:
        LimitError: They are too many.
    """
    letters = around + len(attributes.get("name", ""))
    if letters > MAX_NAME:
        raise LimitError(
            f"a name, with those of all elements around it, has at most {MAX_NAME:,} characters",
            source=source,
        )
    return letters


def label(tag: str, attributes: dict[str, str]) -> str:
    """Return one step of an element path, such as ``link[@name='base']``; short for long names."""
    for key in _NAMED:
        value = attributes.get(key)
        if value:
            return f"{tag[:MAX_PLACE]}[@{key}='{value[:MAX_PLACE]}']"
    return tag[:MAX_PLACE]
