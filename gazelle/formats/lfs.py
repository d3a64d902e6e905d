"""Pointers of Git LFS: a few lines of text that stand for a file which was not fetched."""

from __future__ import annotations

from pathlib import Path

from gazelle.errors import FormatError
from gazelle.formats.limits import refuse_special

_BEGINS = b"version https://git-lfs"


def refuse_pointer(data: bytes, path: Path) -> None:
    """Raise an error if a file holds only a pointer to its content.

    Raises:
        FormatError: It is.
    """
    if data.startswith(_BEGINS):
        raise FormatError(
            "the file is a pointer of Git LFS, not its content",
            file=str(path),
            line=1,
            hint="run 'git lfs pull' in its repository",
        )


def refuse_pointer_file(path: Path) -> None:
    """Raise an error if there is a file that holds only a pointer to its content."""
    refuse_special(path)
    try:
        with path.open("rb") as file:
            head = file.read(len(_BEGINS))
    except OSError:
        return
    refuse_pointer(head, path)
