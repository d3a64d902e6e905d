"""Formats of world files that are no XML, such as Stage's.

Their readers are found by entry points of the group ``gazelle.formats``, each of which gives a
``WorldFormat``.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from dataclasses import dataclass

from gazelle.description import World
from gazelle.errors import FormatError
from gazelle.formats.reading import Reading
from gazelle_ros.base.entry_points import entry_points_of, load

_GROUP = "gazelle.formats"
_BLANK = b" \t\r\n\xef\xbb\xbf"


@dataclass(frozen=True, slots=True)
class WorldFormat:
    """Format of world files that are no XML.

    Attributes:
        recognizes: Returns whether a file is of it: called with its content, and the suffix of its
            name or "" for text without a name.
        read: Returns the world of a text: called with it, the name that stands for the file in
            errors, and what finds files and takes remarks.
    """

    recognizes: Callable[[bytes, str], bool]
    read: Callable[[bytes, str, Reading], World]


def find_world_format(data: bytes, suffix: str = "") -> WorldFormat | None:
    """Return the format of a file by its content and the suffix of its name; None for XML and others.

    Raises:
        FormatError: A format of another package cannot be loaded.
    """
    if data.lstrip(_BLANK).startswith(b"<"):
        return None
    return next((each for each in _formats() if each.recognizes(data, suffix)), None)


@functools.cache
def _formats() -> tuple[WorldFormat, ...]:
    return tuple(_load(name) for name in sorted(entry_points_of(_GROUP)))


def _load(name: str) -> WorldFormat:
    found: WorldFormat = load(entry_points_of(_GROUP)[name], f"the format '{name}'", FormatError)
    return found
