"""World files of Stage (``.world``, ``.inc``) to descriptions."""

from __future__ import annotations

import os
import re
from collections.abc import Sequence

from gazelle.description import World
from gazelle.formats import xml
from gazelle.formats.reading import Reading
from gazelle.formats.resolve import Resolver
from gazelle.formats.world_formats import WorldFormat
from gazelle.stage.description.models import StageWorld
from gazelle.stage.format.building import gc_disabled
from gazelle.stage.format.parser import script_of
from gazelle.stage.format.scene import scene_of
from gazelle.stage.format.world import read_world
from gazelle_ros.base.path_texts import existing_file

SUFFIXES = (".world", ".inc")

_START = re.compile(
    rb"""(?: \s++ | \#[^\r\n]*+ | \xef\xbb\xbf )*+
    (?: include \s* " | define \s+ [A-Za-z][\w.-]* \s+ [A-Za-z] | [A-Za-z][\w.-]* \s* ["(\[\d.+-] )
    """,
    re.VERBOSE,
)

__all__ = ["FORMAT", "SUFFIXES", "is_stage", "load_stage", "read_stage", "scene_of"]


def is_stage(data: bytes, suffix: str = "") -> bool:
    """Return whether a file looks like one of Stage's: a word and a value, a body or a definition.

    Args:
        data: Content.
        suffix: Of its name; one of Stage's own decides where the text does not look like XML.
    """
    if data.lstrip(b" \t\r\n\xef\xbb\xbf").startswith(b"<"):
        return False
    return _START.match(data) is not None or (bool(data.strip()) and suffix in SUFFIXES)


def load_stage(
    path: str | os.PathLike[str], *, paths: Sequence[str | os.PathLike[str]] = ()
) -> StageWorld:
    """Load a Stage file in Stage's vocabulary.

    Args:
        path: The file. Others that it names are looked for from its folder, from theirs, and
            in the folders of ``STAGEPATH``.
        paths: Folders to search before all others.

    Raises:
        FormatError: The file cannot be read, or says something that is impossible; it names file
            and line.
        ResolveError: There is no such file, or one that it names is not there.
    """
    file = existing_file(path)
    reading = Reading(Resolver(paths, file=file))
    with reading.inside(file), gc_disabled():
        script = script_of(str(file), xml.read_bytes(file), reading)
        world = read_world(script, reading, file.parent)
    reading.report(strict=False)
    return world


def read_stage(data: bytes, name: str, reading: Reading) -> World:
    """Read the world of a Stage file's text; ``World.content`` holds what it says.

    Args:
        data: The text.
        name: Stands for the file in errors.
        reading: Finds what it names, takes remarks.

    Raises:
        FormatError: The text says something that is impossible.
        ResolveError: A file that it names is not there.
    """
    with gc_disabled():
        stage = read_world(script_of(name, data, reading), reading, reading.folder)
        return scene_of(stage, reading)


FORMAT = WorldFormat(is_stage, read_stage)
"""Entry point by which ``gazelle.formats.load`` finds Stage's files."""
