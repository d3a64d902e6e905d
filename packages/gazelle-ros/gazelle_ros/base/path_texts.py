"""Texts that name files."""

from __future__ import annotations

import os
from pathlib import Path

from gazelle_ros.base.errors import ResolveError

MAX_NAME = 255
"""Bytes of the name of a file or folder."""

MAX_PATH = 4095
"""Bytes of a path."""


def can_be_path(text: str | os.PathLike[str]) -> bool:
    """Return False for a text that no file can have as its path: too long, or with a null in it."""
    try:
        data = os.fsencode(text)
    except UnicodeEncodeError:
        return False
    longest = max(map(len, data.split(b"/")))
    return b"\x00" not in data and len(data) <= MAX_PATH and longest <= MAX_NAME


def expanded(path: str | os.PathLike[str]) -> Path:
    """Return a path with ``~`` as the user's folder, as it is written where there is no such user."""
    try:
        return Path(path).expanduser()
    except RuntimeError:
        return Path(path)


def existing_file(path: str | os.PathLike[str]) -> Path:
    """Return the absolute path of a file.

    Raises:
        ResolveError: There is none.
    """
    file = expanded(path).absolute()
    if not can_be_path(path) or not file.is_file():
        raise ResolveError("there is no such file", file=shortened(os.fspath(path)))
    return file


def shortened(text: str) -> str:
    """Return a text as messages show it: its beginning, where it is longer than any path."""
    return text if len(text) <= MAX_NAME else f"{text[:MAX_NAME]}..."
