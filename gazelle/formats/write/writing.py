"""State of one save: the folder of the file, and notes on what the format cannot express."""

from __future__ import annotations

import warnings
from dataclasses import dataclass, field
from pathlib import Path

from gazelle.description import Source
from gazelle.errors import FormatWarning
from gazelle.formats.reading import Note, note_text


@dataclass(slots=True)
class Writing:
    """The state of one save.

    Attributes:
        folder: Folder that the file will stand in, or None.
        notes: Content that the format cannot express.
    """

    folder: Path | None = None
    notes: list[Note] = field(default_factory=list)

    def note(self, message: str, source: Source | None, hint: str | None = None) -> None:
        """Record a remark, once for each place."""
        note = Note(message, source, hint)
        if note not in self.notes:
            self.notes.append(note)

    def uri(self, uri: str, path: Path | None) -> str:
        """Return a URI that leads to the same file from the new place.

        Only relative names change: to the way from there, or to an absolute one.
        """
        if path is None or "://" in uri or Path(uri).is_absolute():
            return uri
        if self.folder is not None and _same(self.folder / uri, path):
            return uri
        return self.name(path)

    def name(self, path: Path) -> str:
        """Return a file's path relative to the folder if it is below, else the absolute path."""
        if self.folder is not None and path.is_relative_to(self.folder):
            return path.relative_to(self.folder).as_posix()
        # not as_uri(): neither libsdformat nor Gazebo turns %20 into a blank
        return f"file://{path.absolute().as_posix()}"

    def report(self) -> None:
        """Issue the remarks as warnings."""
        for note in self.notes:
            warnings.warn(note_text(note), FormatWarning, stacklevel=4)


def _same(one: Path, other: Path) -> bool:
    return one.resolve() == other.resolve()
