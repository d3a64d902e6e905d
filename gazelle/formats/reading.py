"""State of one load: the resolver, the current position, and problems found."""

from __future__ import annotations

import re
import warnings
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal

from gazelle.description import Parameters, Source
from gazelle.errors import FormatError, FormatWarning, ResolveError, describe
from gazelle.formats.limits import MAX_FILES
from gazelle.formats.resolve import Resolver

MAX_INCLUDES = 32

_NAMES_AND_NUMBERS = re.compile(r"'[^']*'|[-+]?\d[\d.eE+-]*")
_LINES_NAMED = 10


@dataclass(frozen=True, slots=True)
class Miss:
    """A URI that led nowhere.

    Attributes:
        uri: As in the file.
        source: Its position in the file.
        looked: Searched places.
    """

    uri: str
    source: Source | None
    looked: str


@dataclass(frozen=True, slots=True)
class Note:
    """A remark about the file, that becomes a warning when the load is done.

    Attributes:
        message: Description of the fault and its replacement.
        source: Place in a file.
        hint: Fix.
        severity: An error is what the format does not allow, and Gazebo continues with.
        rule: Name of what is found, where a check finds it in a description too.
    """

    message: str
    source: Source | None = None
    hint: str | None = None
    severity: Literal["error", "warning"] = "warning"
    rule: str | None = None


@dataclass(slots=True)
class Reading:
    """The state of one load.

    Attributes:
        resolver: Finds files.
        folder: Folder that relative names start from.
        xacro_args: Arguments for xacro files.
        misses: Missing files.
        notes: Notes on parts that are not simulated as written, in the order found.
        including: Files being read, outermost first.
        files: Number of files that were read so far, each as often as it was.
    """

    resolver: Resolver
    folder: Path | None = None
    xacro_args: Mapping[str, str] = field(default_factory=dict)
    misses: list[Miss] = field(default_factory=list)
    notes: dict[Note, None] = field(default_factory=dict)
    including: list[Path] = field(default_factory=list)
    files: int = 0

    @property
    def is_plain(self) -> bool:
        """True if neither search folders nor arguments of xacro files were given."""
        return not self.resolver.paths and not self.xacro_args

    def find(self, uri: str, node: Parameters, *, required: bool = True) -> Path | None:
        """Return the file behind a URI; a miss is recorded when it is required."""
        path = self.resolver.find(uri, self.folder)
        if path is None and required and not any(miss.uri == uri for miss in self.misses):
            self.misses.append(Miss(uri, node.source, self.resolver.looked_in(uri, self.folder)))
        return path

    def note(
        self, message: str, node: Parameters, hint: str | None = None, *, rule: str | None = None
    ) -> None:
        """Record a remark about an element, once for each place."""
        self._keep(Note(message, node.source, hint, rule=rule))

    def remark(self, message: str, source: Source | None, hint: str | None = None) -> None:
        """Record a remark, once for each place."""
        self._keep(Note(message, source, hint))

    def fault(self, message: str, node: Parameters, hint: str | None = None) -> None:
        """Record a fault of an element, and the value used instead.

        For what the format does not allow, and Gazebo or libsdformat continue with all the same:
        a load warns of it, a check counts it as an error.
        """
        self._keep(Note(message, node.source, hint, "error"))

    def tolerate(self, error: FormatError, taken: str) -> None:
        """Record an error as a fault that does not end the load, and the value used instead."""
        source = Source(error.file, error.line, error.element)
        self._keep(Note(f"{error.message}: {taken}", source, error.hint, "error"))

    def misread(
        self, message: str, source: Source, severity: Literal["error", "warning"] = "error"
    ) -> None:
        """Record a fault in the text of a file, as found by ``xml.parse``."""
        self._keep(Note(message, source, severity=severity))

    def _keep(self, note: Note) -> None:
        self.notes.setdefault(note)

    @contextmanager
    def inside(self, file: Path, node: Parameters | None = None) -> Iterator[None]:
        """Read another file: relative names start from its folder while it lasts.

        Raises:
            FormatError: The file is already being read, or includes go too deep.
        """
        source = node.source if node is not None else None
        if file in self.including:
            raise FormatError(f"'{file}' includes itself", source=source)
        if len(self.including) >= MAX_INCLUDES:
            raise FormatError(f"more than {MAX_INCLUDES} includes in each other", source=source)
        self.files += 1
        if self.files > MAX_FILES:
            raise FormatError(f"more than {MAX_FILES:,} files are included", source=source)
        outer = self.folder
        self.including.append(file)
        self.folder = file.parent
        self.resolver.look_around(file)
        try:
            yield
        finally:
            self.including.pop()
            self.folder = outer

    def report(self, *, strict: bool) -> None:
        """Issue the remarks as warnings, all misses as one.

        Raises:
            ResolveError: Something was not found, and ``strict`` is set.
        """
        for text in grouped(self.notes):
            warnings.warn(text, FormatWarning, stacklevel=4)
        if not self.misses:
            return
        if strict:
            raise ResolveError(misses_text(self.misses), source=self.misses[0].source)
        place = self.misses[0].source
        text = misses_text(self.misses)
        if place is not None:
            text = describe(text, file=place.file, line=place.line, element=place.element)
        warnings.warn(text, FormatWarning, stacklevel=4)


def grouped(notes: Iterable[Note]) -> list[str]:
    """Return remarks as lines of text; those that differ only in names and numbers are one."""
    kinds: dict[tuple[str, str | None], list[Note]] = {}
    for note in notes:
        file = None if note.source is None else note.source.file
        kinds.setdefault((_NAMES_AND_NUMBERS.sub("", note.message), file), []).append(note)
    return [note_text(alike[0]) + _others(alike[1:]) for alike in kinds.values()]


def _others(notes: list[Note]) -> str:
    """Return a text with the number and lines of the other remarks of a kind."""
    if not notes:
        return ""
    lines = [str(note.source.line) for note in notes if note.source and note.source.line]
    named = ", ".join(dict.fromkeys(lines[:_LINES_NAMED]))
    more = ", ..." if len(lines) > _LINES_NAMED else ""
    where = f" (lines {named}{more})" if lines else ""
    return f"; and {len(notes)} more like this{where}"


def note_text(note: Note) -> str:
    """Return a remark as one line with its place."""
    place = note.source or Source()
    return describe(
        note.message, file=place.file, line=place.line, element=place.element, hint=note.hint
    )


def misses_text(misses: list[Miss]) -> str:
    """Return all misses as one line."""
    parts = []
    for miss in misses:
        line = f" (line {miss.source.line})" if miss.source and miss.source.line else ""
        parts.append(f"'{miss.uri}'{line}")
    places = "; ".join(dict.fromkeys(miss.looked for miss in misses))
    return f"not found: {', '.join(parts)}; {places}"
