"""Xacro files, through the ``xacro`` package, with no ROS.

Each element of the result knows the file and line it was written in, also when it came
out of a macro: elements keep their place through xacro's DOM.
"""

from __future__ import annotations

import builtins
import contextlib
import io
import os
import threading
import xml.dom.minidom as dom
from collections.abc import Callable, Iterator
from pathlib import Path
from types import MappingProxyType, TracebackType
from typing import Any
from xml.dom import expatbuilder
from xml.dom.minicompat import NodeList
from xml.parsers.expat import ExpatError

import xacro as engine
from xacro import substitution_args

from gazelle.description import Parameters, Source
from gazelle.errors import FormatError
from gazelle.formats import xml
from gazelle.formats.lfs import refuse_pointer_file
from gazelle.formats.limits import MAX_TEXT
from gazelle.formats.reading import Reading
from gazelle.formats.xacro_hints import hint_of
from gazelle_ros.base import bounded_expressions as expressions
from gazelle_ros.base import bounded_texts, bounded_yaml, xacro_engine
from gazelle_ros.base.bundled_packages import published, published_hint

_LOCK = threading.Lock()  # the package keeps its state in module globals

MAX_MADE = 60_000
MAX_INCLUDED = 20
"""Number of times that a file may be included by what it includes."""


class _Made(threading.local):
    """Number of elements that macros have made in the current expansion."""

    count = 0


_made = _Made()


class _Children(NodeList[Any]):
    """Child nodes that are found at once near the place where the last one was.

    Minidom searches all children for each that it replaces, which takes long in a robot of a
    thousand links; xacro replaces them one after the other.
    """

    __slots__ = ("_near",)

    def index(self, value: Any, *between: Any) -> int:
        """Return the index of a child."""
        near: int = getattr(self, "_near", 0)
        if not between:
            for at in (near, near + 1):
                if at < len(self) and self[at] is value:
                    self._near = at
                    return at
        self._near = at = super().index(value, *between)
        return at

    def remove(self, value: Any) -> None:
        """Remove a child."""
        del self[self.index(value)]


class PlacedElement(dom.Element):
    """A DOM element that knows where it was written, and passes it to copies."""

    place: tuple[str, int] | None = None

    def cloneNode(self, deep: bool) -> Any:  # noqa: N802, FBT001  # the name is the DOM's
        """Return a copy with the same place.

        Raises:
            FormatError: Macros have made more than ``MAX_MADE`` elements.
        """
        _made.count += 1
        if _made.count > MAX_MADE:
            raise FormatError(f"the macros make more than {MAX_MADE} elements")
        copy = PlacedElement(self.tagName, self.namespaceURI, self.prefix)
        copy.ownerDocument = self.ownerDocument
        copy.childNodes = _Children()
        copy.place = self.place
        for name, value in self.attributes.items():
            copy.setAttribute(name, value)
        inner: list[Any] = list(self.childNodes) if deep else []
        for child in inner:
            copy.appendChild(child.cloneNode(deep))
        return copy


def is_xacro(root: Parameters) -> bool:
    """Return whether an XML file is meant for xacro: it names the namespace or uses its tags."""
    if any(key == "xmlns:xacro" for key in root.attributes):
        return True
    return any(
        child.tag.startswith(xacro_engine.PREFIX)
        or xacro_engine.lacks_prefix(child.tag, child.attributes)
        for child in root.children
    )


def expand(path: Path, reading: Reading) -> Parameters:
    """Return the root element of a xacro file, all macros expanded.

    Raises:
        FormatError: The file, or one that it includes, is not valid xacro.
    """
    return _run(str(path), xml.read_bytes(path), reading)


def expand_text(text: str | bytes, name: str, reading: Reading) -> Parameters:
    """Return the root element of xacro text; ``name`` stands for the file in errors."""
    return _run(name, text.encode() if isinstance(text, str) else text, reading)


def _run(name: str, data: bytes, reading: Reading) -> Parameters:
    with _LOCK, _patched(reading) as output:
        engine.init_stacks(name)
        _made.count = 0
        expressions.begin()
        try:
            document = xacro_engine.prefix(_parse(data, name, reading), _reporter(reading))
            engine.process_doc(document, mappings=dict(reading.xacro_args))
        except RecursionError as error:
            file, line, element = _place(error.__traceback__) or (name, None, None)
            text = "the macros call each other without end"
            raise FormatError(text, file=file, line=line, element=element) from None
        except Exception as error:  # expressions in a file may raise anything
            raise _explain(error, name) from error
    root: Any = document.documentElement
    for text in dict.fromkeys(output.getvalue().splitlines()):
        if text.strip().startswith(("warning", "Warning")) or "deprecated" in text:
            reading.note(f"xacro: {text.strip()}", Parameters("robot", source=Source(name, 1)))
    return _convert(root, name, None, {})


class _DomBuilder(expatbuilder.ExpatBuilderNS):
    """Builder of a DOM with places of its elements."""

    def __init__(self, file: str) -> None:
        super().__init__()
        self._file = file

    def start_element_handler(self, name: str, attributes: Any) -> None:
        """Mark the element that has just started."""
        super().start_element_handler(name, attributes)
        element: Any = self.curNode
        element.__class__ = PlacedElement
        element.childNodes = _Children()
        element.place = (self._file, self.getParser().CurrentLineNumber)


def _parse(data: bytes, name: str, reading: Reading) -> Any:
    """Parse a DOM with lines of its elements; entities are rejected as elsewhere."""
    _, text = xml.parsed(data, name=name, report=reading.misread)
    return _DomBuilder(name).parseString(text)


@contextlib.contextmanager
def _patched(reading: Reading) -> Iterator[io.StringIO]:
    """Set the package to find packages and open files only through the resolver."""

    def find(package: str) -> str:
        folder = reading.resolver.package(package)
        if folder is None:
            looked = reading.resolver.looked_in(f"package://{package}")
            raise FormatError(
                f"there is no package '{package}'", hint=f"{looked}; give its folder as a path"
            )
        return str(folder)

    def parse(document: Any, filename: str | None = None) -> Any:
        if document is not None or filename is None:
            return document
        _refuse_ring(engine.filestack)
        path = _checked(filename)
        return _parse(xml.read_bytes(path), _plain(path), reading)

    def _checked(filename: str) -> Path:
        path = published(filename)
        if not path.is_file():
            raise FormatError(
                f"there is no file '{filename}' to include", hint=published_hint(path)
            )
        if not reading.resolver.readable(path):
            raise FormatError(f"'{filename}' lies outside of the folders that may be read")
        return path

    def guarded_open(filename: str) -> Any:
        path = _checked(filename)
        refuse_pointer_file(path)
        bounded_yaml.compose(xml.read_bytes(path))
        return builtins.open(path, encoding="utf-8")  # noqa: PTH123

    output = io.StringIO()
    symbols = engine._global_symbols  # noqa: SLF001  # the package has no public access
    bounded: dict[str, Any] = {"range": expressions.bounded_range, "str": bounded_texts.text}
    inner = symbols["xacro"]
    with contextlib.ExitStack() as stack:
        for names, values in (
            (vars(engine), {"parse": parse, "open": guarded_open, "eval_text": _eval_text}),
            (vars(engine), {"safe_eval": expressions.evaluate}),
            (vars(substitution_args), {"eval": expressions.evaluate_plain}),
            (symbols, bounded | {"load_yaml": _once(symbols["load_yaml"])}),
            (inner, {"load_yaml": _once(inner["load_yaml"])}),
            (symbols["python"], bounded | {"vars": expressions.no_vars}),
        ):
            stack.enter_context(xacro_engine.replaced(names, values))
        stack.enter_context(xacro_engine.adapted(find, _reporter(reading)))
        stack.enter_context(contextlib.redirect_stderr(output))
        yield output


def _once(load: Callable[[str], Any]) -> Callable[[str], Any]:
    """Return a function that loads a YAML file once, however many macros need it."""
    loaded: dict[str, Any] = {}

    def load_once(filename: str) -> Any:
        path = engine.abs_filename_spec(filename)
        if path not in loaded:
            loaded[path] = load(filename)
        return loaded[path]

    return load_once


def _reporter(reading: Reading) -> xacro_engine.Report:
    """Return what notes a tag without xacro's prefix at its place."""

    def report(tag: str, node: Any) -> None:
        file, line = getattr(node, "place", None) or (None, None)
        label = xml.label(tag, dict(node.attributes.items()))
        message = f"'{tag}' {xacro_engine.NO_PREFIX}"
        reading.remark(message, Source(file, line, label), f"write <{xacro_engine.PREFIX}{tag}>")

    return report


def _refuse_ring(files: list[Any]) -> None:
    """Raise an error if the last of files that include each other includes itself repeatedly.

    Raises:
        FormatError: It does.
    """
    names = [_plain(Path(file)) for file in files if file]
    turns = [place for place, name in enumerate(names) if name == names[-1]]
    if len(turns) > MAX_INCLUDED:
        ring = " -> ".join(names[turns[0] : turns[1] + 1])
        raise FormatError(f"the files include each other without end: {ring}")


def _plain(path: Path) -> str:
    """Return a path without steps up, if that is the same file."""
    plain = os.path.normpath(path)
    return plain if os.path.realpath(plain) == os.path.realpath(path) else str(path)


_evaluate_text = engine.eval_text


def _eval_text(text: str, symbols: Any) -> Any:
    """Evaluate a text; most hold no expression, and are returned at once.

    Raises:
        FormatError: It makes a text that is too long, such as properties do that repeat each other.
    """
    if text and "$" not in text:
        return text
    value = _evaluate_text(text, symbols)
    if isinstance(value, list | tuple):
        bounded_texts.check_written([value])
    if isinstance(value, str) and len(value) > MAX_TEXT:
        raise FormatError(f"the expression makes more than {MAX_TEXT:,} characters")
    return value


def _explain(error: Exception, name: str) -> FormatError:
    """Return the error with the place of the element that xacro was at."""
    root: BaseException = error
    while isinstance(root, engine.XacroException) and isinstance(root.exc, BaseException):
        root = root.exc
    if isinstance(root, FormatError) and root.file is not None:
        return root
    file, line, element = _place(error.__traceback__) or (_current(name), None, None)
    if isinstance(root, ExpatError):
        return FormatError(f"this is not well-formed XML: {root}", file=_current(name))
    if isinstance(root, FormatError):
        return FormatError(root.message, file=file, line=line, element=element, hint=root.hint)
    text = " ".join(str(error).split()) or type(error).__name__
    hint = hint_of(text, error.__traceback__)
    return FormatError(f"xacro: {text}", file=file, line=line, element=element, hint=hint)


def _current(name: str) -> str:
    stack = engine.filestack
    return str(stack[-1]) if stack and stack[-1] else name


def _place(trace: TracebackType | None) -> tuple[str, int, str] | None:
    """Return the innermost element in the local variables of xacro's functions."""
    found = None
    while trace is not None:
        for variable in ("node", "elt", "tag"):
            element = trace.tb_frame.f_locals.get(variable)
            if isinstance(element, PlacedElement) and element.place is not None:
                label = xml.label(element.tagName, dict(element.attributes.items()))
                found = (*element.place, label)
        trace = trace.tb_next
    return found


def _convert(node: Any, file: str, outer: Source | None, counts: dict[str, int]) -> Parameters:
    """Convert a DOM element to ``Parameters``.

    One that xacro made stands where its parent does.
    """
    attributes = {
        key: value for key, value in node.attributes.items() if not key.startswith("xmlns")
    }
    place = getattr(node, "place", None)
    if place is None:
        place = (file, 0) if outer is None else (outer.file or file, outer.line or 0)
    step = xml.label(node.tagName, attributes)
    if step == node.tagName and outer is not None:
        number = counts[step] = counts.get(step, 0) + 1
        step = step if number == 1 else f"{step}[{number}]"
    path = step if outer is None else xml.below(outer.element or "", step)
    source = Source(place[0], place[1] or None, path)
    xml.refuse_long_name(attributes, source)
    text: list[str] = []
    children: list[Parameters] = []
    inner: dict[str, int] = {}
    for child in node.childNodes:
        if child.nodeType == child.ELEMENT_NODE:
            children.append(_convert(child, file, source, inner))
        elif child.nodeType in {child.TEXT_NODE, child.CDATA_SECTION_NODE} and not children:
            text.append(child.data)
    return Parameters(
        node.tagName,
        "".join(text).strip(),
        MappingProxyType(attributes),
        tuple(children),
        source,
    )
