"""XML of launch files as elements that know their lines."""

from __future__ import annotations

import re
import warnings
from collections.abc import Iterator
from dataclasses import dataclass, field
from xml.parsers import expat

from gazelle_ros.base import characters
from gazelle_ros.base.bundled_packages import published, published_hint
from gazelle_ros.base.errors import FormatWarning, describe
from gazelle_ros.launch.errors import LaunchError
from gazelle_ros.launch.limits import read_bounded

_DEEPEST = 200

_ADVICE = (
    (re.compile(r"&(?!\w+;|#)"), "write & as &amp;"),
    (re.compile(r"<!--.*--.*-->|^(?!.*(<!--|-->)).*--"), "-- may not stand in a comment"),
    (re.compile(r"""<[^>]*=\s*[^"'\s>]"""), "write values in quotes"),
    (re.compile(r"<\?xml"), 'write <?xml version="1.0"?> at the very beginning, or leave it out'),
)
"""Patterns of lines that are not well-formed, with advice."""


@dataclass(slots=True)
class Element:
    """One element of a launch file, or of a robot's description."""

    tag: str
    attributes: dict[str, str]
    file: str
    line: int
    children: list[Element] = field(default_factory=list)
    text: str = ""
    """Its own character data, without that of its children."""

    @property
    def label(self) -> str:
        """The element as errors name it, such as ``node[@name='talker']``."""
        for key in ("name", "file", "from", "param", "ns"):
            if key in self.attributes:
                return f"{self.tag}[@{key}='{self.attributes[key]}']"
        return self.tag

    def all(self, tag: str) -> Iterator[Element]:
        """Yield this element and those below it that have a tag, from top to bottom."""
        if self.tag == tag:
            yield self
        for child in self.children:
            yield from child.all(tag)

    def find(self, tag: str) -> Element | None:
        """Return the first child that has a tag; None if there is none."""
        return next((child for child in self.children if child.tag == tag), None)

    def error(self, message: str, hint: str | None = None) -> LaunchError:
        """Return an error that names this element."""
        return LaunchError(message, file=self.file, line=self.line, element=self.label, hint=hint)


def read_document(path: str) -> Element:
    """Read the ``<launch>`` element of a file.

    Raises:
        LaunchError: There is no such file, it is not XML, or it has not exactly one ``<launch>``.
    """
    try:
        data = read_bounded(published(path))
    except FileNotFoundError:
        hint = published_hint(path)
        raise LaunchError("there is no such launch file", file=path, hint=hint) from None
    except IsADirectoryError:
        raise LaunchError("this is a folder, not a launch file", file=path) from None
    except OSError as error:  # such as a name that is too long
        raise LaunchError(f"cannot be read: {error.strerror}", file=path) from None
    return parse_document(data, path)


def parse_document(data: bytes, name: str) -> Element:
    """Parse the ``<launch>`` element of XML; ``name`` stands for the file in errors.

    Raises:
        LaunchError: It is not XML, or has not exactly one ``<launch>``.
    """
    root = parse_element(data, name)
    found = list(root.all("launch"))
    if not found:
        raise LaunchError(
            "a launch file has a <launch> element", file=name, line=root.line, element=root.tag
        )
    if len(found) > 1:
        raise LaunchError("there is more than one <launch> element", file=name, line=found[1].line)
    return found[0]


def parse_element(data: bytes, name: str) -> Element:
    """Parse the root element of XML; ``name`` stands for the file in errors.

    No-break spaces and the like are taken as spaces, with a warning.

    Raises:
        LaunchError: It is not XML.
    """
    data, line = characters.plain_bytes(data, characters.XML_COMMENT)
    if line is not None:
        text = describe(characters.MESSAGE, file=name, line=line)
        warnings.warn(text, FormatWarning, stacklevel=4)
    return _DocumentBuilder(name).parse(data)


def _advice(data: bytes, line: int) -> str | None:
    """Return advice for a line that is not well-formed."""
    try:
        lines = data.decode().splitlines()
    except UnicodeDecodeError:
        return 'save it as UTF-8, or name its encoding: <?xml version="1.0" encoding="latin-1"?>'
    text = lines[line - 1] if line <= len(lines) else ""
    fitting = (advice for pattern, advice in _ADVICE if pattern.search(text))
    return characters.curly_hint(text) or next(fitting, None)


class _DocumentBuilder:
    """Makes elements of what expat reports."""

    def __init__(self, file: str) -> None:
        self._file = file
        self._root: Element | None = None
        self._open: list[Element] = []
        self._parser = expat.ParserCreate()
        self._parser.buffer_text = True
        self._parser.StartElementHandler = self._start
        self._parser.EndElementHandler = self._end
        self._parser.CharacterDataHandler = self._data
        self._parser.EntityDeclHandler = self._entity

    def parse(self, data: bytes) -> Element:
        try:
            self._parser.Parse(data, True)
        except expat.ExpatError as error:
            raise self._malformed(error, data) from None
        except LaunchError:
            raise
        except (ValueError, LookupError) as error:
            raise LaunchError(f"the encoding cannot be read: {error}", file=self._file) from None
        if self._root is None:
            raise LaunchError("there is no element in it", file=self._file)
        return self._root

    def _malformed(self, error: expat.ExpatError, data: bytes) -> LaunchError:
        text = expat.ErrorString(error.code)
        hint = None
        unclosed = {expat.errors.XML_ERROR_TAG_MISMATCH, expat.errors.XML_ERROR_NO_ELEMENTS}
        if text in unclosed and self._open:
            last = self._open[-1]
            hint = f"<{last.tag}> of line {last.line} is not closed"
        message = f"this is not well-formed XML: {text}"
        advice = hint or _advice(data, error.lineno)
        return LaunchError(message, file=self._file, line=error.lineno, hint=advice)

    def _start(self, tag: str, attributes: dict[str, str]) -> None:
        element = Element(tag, attributes, self._file, self._parser.CurrentLineNumber)
        if self._open:
            self._open[-1].children.append(element)
        else:
            self._root = element
        self._open.append(element)
        if len(self._open) > _DEEPEST:
            raise element.error(f"elements are nested more than {_DEEPEST} deep")

    def _end(self, _tag: str) -> None:
        self._open.pop()

    def _data(self, text: str) -> None:
        if self._open:
            self._open[-1].text += text

    def _entity(self, name: str, *_rest: object) -> None:
        raise LaunchError(
            f"the file declares the entity '{name}'; entities are not read",
            file=self._file,
            line=self._parser.CurrentLineNumber,
        )
