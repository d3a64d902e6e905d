"""Folders and names of packages below a folder of ROS_PACKAGE_PATH, by rospack's rules.

The rules are those of http://www.ros.org/reps/rep-0122.html and of rospack.
"""

from __future__ import annotations

import math
import os
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from xml.parsers import expat

from gazelle_ros.base import characters

IGNORED = "CATKIN_IGNORE"
NOT_DEEPER = "rospack_nosubdirs"
MANIFESTS = frozenset({"package.xml", "manifest.xml"})

_DEEPEST = 12
_MOST_BYTES = 1 << 20


def package_folders(root: Path, *, most: float = math.inf) -> Iterator[Path]:
    """Return the packages below a folder, depth first, folders by the alphabet.

    A package is not searched further, nor are a folder with ``CATKIN_IGNORE``, one with
    ``rospack_nosubdirs`` and hidden ones. Links are followed.

    Args:
        root: Start folder; it may be a package itself.
        most: Largest number of searched folders.
    """
    return _below(root, _DEEPEST, set(), most)


def package_name(folder: Path) -> str:
    """Return the name in a folder's ``package.xml``, or the folder's own without one.

    A search reads hundreds of these files, so each is read up to its name only.
    """
    try:
        with (folder / "package.xml").open("rb") as file:
            data = file.read(_MOST_BYTES)
    except (OSError, ValueError):
        return folder.name
    name = _name_in(data) or _name_in(characters.plain_bytes(data, characters.XML_COMMENT)[0])
    return name or folder.name


def _name_in(manifest: bytes) -> str:
    """Return the name in a manifest; empty without one, or if it is damaged before it."""
    name = _NameReader()
    with suppress(_NameFoundError, expat.ExpatError, LookupError, ValueError):
        name.parser.Parse(manifest)
    return name.text.strip()


class _NameFoundError(Exception):
    """Ends the parser at the end of the name."""


class _NameReader:
    """Collects the text of the ``<name>`` in the root element of a manifest."""

    def __init__(self) -> None:
        self.text = ""
        self._open: list[str] = []
        self.parser = expat.ParserCreate()
        self.parser.StartElementHandler = self._start
        self.parser.EndElementHandler = self._end
        self.parser.CharacterDataHandler = self._take
        self.parser.EntityDeclHandler = self._refuse

    @property
    def _named(self) -> bool:
        return len(self._open) == 2 and self._open[1] == "name"

    def _start(self, tag: str, _: dict[str, str]) -> None:
        self._open.append(tag)

    def _end(self, _: str) -> None:
        done = self._named and bool(self.text.strip())
        self._open.pop()
        if done:
            raise _NameFoundError

    def _take(self, text: str) -> None:
        if self._named:
            self.text += text

    def _refuse(self, *_: object) -> None:
        raise _NameFoundError  # entities of its own: no manifest has them, but bombs do


def _below(folder: Path, depth: int, seen: set[str], most: float) -> Iterator[Path]:
    real = os.path.realpath(folder)
    if real in seen or len(seen) >= most:  # links may lead in circles
        return
    seen.add(real)
    try:
        with os.scandir(folder) as entries:
            listed = sorted(entries, key=lambda entry: entry.name)
    except OSError:
        return
    names = {entry.name for entry in listed}
    if IGNORED in names:
        return
    if not MANIFESTS.isdisjoint(names):
        yield folder
        return
    if depth == 0 or NOT_DEEPER in names:
        return
    for entry in listed:
        if entry.name[0] != "." and entry.is_dir():
            yield from _below(Path(entry.path), depth - 1, seen, most)
