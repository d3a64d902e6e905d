"""Descriptions to files and texts of any format that can be written."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import Literal, get_args

from gazelle.description import Model, Parameters, World
from gazelle.errors import FormatError, did_you_mean
from gazelle.formats.write.sdf import write_sdf
from gazelle.formats.write.urdf import write_urdf
from gazelle.formats.write.writing import Writing
from gazelle.formats.write.xml import document
from gazelle_ros.base import writing
from gazelle_ros.base.path_texts import expanded

Format = Literal["sdf", "urdf"]

SUFFIXES: dict[str, Format] = {".sdf": "sdf", ".world": "sdf", ".urdf": "urdf"}
_WRITERS: dict[str, Callable[[World | Model, Writing], Parameters]] = {
    "sdf": write_sdf,
    "urdf": write_urdf,
}


def save(
    content: World | Model,
    path: str | os.PathLike[str],
    *,
    format: Format | None = None,  # noqa: A002  # the word that users know
) -> None:
    """Write a world or model to a file, so that ``load`` gives it back.

    SDF holds everything. What URDF has no words for is an error, or a warning that names it.
    Meshes are not copied: a relative name in the file is rewritten to lead to the same mesh.

    Args:
        content: World or model to write; a model alone makes a model file.
        path: The file; an existing one is replaced, once all of the new one is there.
        format: ``sdf`` or ``urdf``; by default from the file's suffix.

    Raises:
        FormatError: The format is not known, or cannot express the content; or the
            file cannot be written.
    """
    file = expanded(path).absolute()
    text = _text(content, format or format_of(file), Writing(file.parent))
    write_text(file, text)


def to_string(
    content: World | Model,
    format: Format,  # noqa: A002  # the word that users know
    *,
    folder: str | os.PathLike[str] | None = None,
) -> str:
    """Return the text that ``save`` would write.

    Args:
        content: World or model to write.
        format: ``sdf`` or ``urdf``.
        folder: Folder the text will stand in, which decides how files are named; by
            default relative names become absolute ones.

    Raises:
        FormatError: As ``save``.
    """
    return _text(content, format, Writing(None if folder is None else Path(folder).absolute()))


def format_of(file: Path) -> Format:
    """Return the format of a file's suffix.

    Raises:
        FormatError: None of those that can be written.
    """
    found = SUFFIXES.get(file.suffix.lower())
    if found is None:
        raise FormatError(
            f"the suffix '{file.suffix}' stands for no format that can be written",
            file=str(file),
            hint=f"there are: {', '.join(sorted(SUFFIXES))}; or give the format",
        )
    return found


def write_text(file: str | os.PathLike[str], text: str) -> None:
    """Write a whole text file or nothing.

    Raises:
        FormatError: It cannot be written.
    """
    if not isinstance(file, str | os.PathLike) or not isinstance(text, str):
        raise FormatError(f"a text is written to a path, not {text!r:.40} to {file!r:.40}")
    try:
        writing.write_text(file, text)
    except OSError as error:
        raise FormatError(f"it cannot be written: {error.strerror}", file=str(file)) from error
    except ValueError as error:  # a character that no path or text has
        raise FormatError(f"it cannot be written: {error}", file=str(file)) from error


def _text(content: World | Model, kind: str, writing: Writing) -> str:
    writer = _WRITERS.get(kind)
    if writer is None:
        hint = (
            "gazelle.engines.mujoco.to_mjcf writes MJCF"
            if kind == "mjcf"
            else did_you_mean(kind, get_args(Format))
        )
        raise FormatError(f"'{kind}' is not a format that can be written here", hint=hint)
    text = document(writer(content, writing))
    writing.report()
    return text
