"""The errors Gazelle raises: one root, and the subclasses of files and of ROS.

Every error can say where the fault is (file, line, element) and what to do
about it (hint). The text is one line: ``FILE:LINE: <ELEMENT>: MESSAGE; HINT``.
"""

from __future__ import annotations

import difflib
import itertools
import re
from collections import Counter
from collections.abc import Iterable, Sequence, Sized
from typing import Protocol

_LEAST_LETTERS = 4  # of a word that is looked for in longer names


class FilePlace(Protocol):
    """A place in a file: of a description, of a launch file."""

    @property
    def file(self) -> str | None:
        """Path or name of the file; None when made by code."""

    @property
    def line(self) -> int | None:
        """Line in that file, counted from 1."""

    @property
    def element(self) -> str | None:
        """The element, such as ``link[@name='base']/inertial/mass``."""


class Error(Exception):
    """Root of all errors that Gazelle raises on purpose.

    Attributes:
        message: Description of the problem, and what was expected.
        file: Path or name of the offending file, if the fault is in one.
        line: Line in that file, counted from 1.
        element: The element, such as ``link[@name='base']/inertial/mass``.
        hint: Fix.
    """

    def __init__(
        self,
        message: str,
        *,
        file: str | None = None,
        line: int | None = None,
        element: str | None = None,
        hint: str | None = None,
        source: FilePlace | None = None,
    ) -> None:
        if source is not None:
            file, line, element = source.file, source.line, source.element
        self.message = message
        self.file = file
        self.line = line
        self.element = element
        self.hint = hint
        super().__init__(describe(message, file=file, line=line, element=element, hint=hint))


class FormatError(Error):
    """A file is malformed, or says something that is impossible."""


class ResolveError(FormatError):
    """A URI or path in a file leads nowhere."""


class RosError(Error):
    """The ROS graph does not answer, or answers wrongly."""


class MissingExtraError(Error):
    """An optional part is not installed; the hint holds the command."""

    def __init__(self, package: str, extra: str, distribution: str = "gazelle") -> None:
        super().__init__(
            f"this needs the package '{package}', which is not installed",
            hint=f'pip install "{distribution}[{extra}]"',
        )


class GazelleWarning(UserWarning):
    """Root of all warnings: something is valid, but not done as written."""


class FormatWarning(GazelleWarning):
    """A file holds something that is ignored, replaced or not supported."""


def describe(
    message: str,
    *,
    file: str | None = None,
    line: int | None = None,
    element: str | None = None,
    hint: str | None = None,
) -> str:
    """Return one line with place, message and hint."""
    place = "" if file is None else f"{file}:" if line is None else f"{file}:{line}:"
    parts = [place, f"<{element}>:" if element else "", message]
    text = " ".join(part for part in parts if part)
    return f"{text}; {hint}" if hint else text


def located(message: str, source: FilePlace | None) -> str:
    """Return a message with its file and line, if they are known."""
    return message if source is None else describe(message, file=source.file, line=source.line)


_CLOSE = 0.6
_REST_CLOSE = 0.75
_MANY = 20
_MOST_COMPARED, _LONGEST_COMPARED = 1_000, 200  # names, and letters of each
_COMMON = 1 / 8
_WORD = re.compile(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])|\d+|[^\W\d_]+")


def _closest(name: str, names: list[str]) -> str | None:
    """Return the most similar name; None if none is similar."""
    close = difflib.get_close_matches(name, names, n=5, cutoff=_CLOSE)
    if len(names) < _MANY:
        swapped = (each for each in close if sorted(each) == sorted(name))
        return next(swapped, close[0] if close else None)
    counts = Counter(word for each in names for word in set(_words(each)))
    common = {word for word, count in counts.items() if count > len(names) * _COMMON}
    for each in close:
        shared = common.intersection(_words(name), _words(each))
        if _alike(_rest(name, shared), _rest(each, shared)):
            return each
    return None


def _words(name: str) -> list[str]:
    return [word.lower() for word in _WORD.findall(name)]


def _rest(name: str, common: set[str]) -> str:
    return "_".join(word for word in _words(name) if word not in common)


def _alike(one: str, other: str) -> bool:
    if not one or not other:
        return one == other
    return difflib.SequenceMatcher(None, one, other).ratio() >= _REST_CLOSE


def closest_of(name: str, known: Iterable[str]) -> str | None:
    """Return a hint that names the closest of the known names; None if none is close.

    A word of a longer name is close to it, as ``burger`` is to ``turtlebot3_burger``, and ``empty``
    to ``empty_world``.
    """
    names = sorted(each for each in known if len(each) <= _LONGEST_COMPARED)
    if not 0 < len(names) <= _MOST_COMPARED or len(str(name)) > _LONGEST_COMPARED:
        return None  # a comparison takes microseconds for each pair of letters
    close = _closest(str(name), names) or _longer(str(name), names) or _shorter(str(name), names)
    return None if close is None else f"did you mean '{close}'?"


def _longer(name: str, known: Iterable[str]) -> str | None:
    """Return the shortest name that has another as one of its words or several; None if none has."""
    if len(name) < _LEAST_LETTERS:
        return None
    whole = re.compile(rf"(?<![a-z0-9]){re.escape(name)}(?![a-z0-9])", re.IGNORECASE)
    return min((each for each in known if whole.search(each)), key=len, default=None)


def _shorter(name: str, known: Iterable[str]) -> str | None:
    """Return the longest name that is a word of another; None if none is."""
    parts = (each for each in known if _longer(each, [name]))
    return max(parts, key=len, default=None)


def did_you_mean(name: str, known: Iterable[str]) -> str:
    """Return a hint that names the closest of the known names, else all of them (the first 20).

    Names must be alike in what makes them different: words that many of the known names have,
    such as ``libgazebo``, ``ros`` and ``so``, do not count.
    """
    if isinstance(known, Sized) and len(known) > _MOST_COMPARED:
        first = list(itertools.islice(known, _MANY))
        return f"there are: {', '.join(first)} and {len(known) - _MANY} more"
    names = sorted(known)
    close = closest_of(name, names)
    if close is not None:
        return close
    return f"there are: {few(names)}" if names else "there are none"


def few(names: Sequence[str]) -> str:
    """Return the first 20 of several names as text, and the number of the others."""
    more = "" if len(names) <= _MANY else f" and {len(names) - _MANY} more"
    return ", ".join(names[:_MANY]) + more
