"""Model folders: ``model.config`` names the file of the model."""

from __future__ import annotations

from pathlib import Path

from gazelle.description import Parameters
from gazelle.errors import FormatError
from gazelle.formats import xml
from gazelle_ros.base.path_texts import can_be_path

NEWEST = (1, 12)


_DIGITS = 9
"""Of a part of a version."""


def entry_file(path: Path) -> Path:
    """Return the file to read: the path itself, or for a folder the file in its ``model.config``.

    Of several, the one of the newest SDF version that can be read is taken.

    Raises:
        FormatError: The folder has no ``model.config``, or that names no file.
    """
    if not path.is_dir():
        return path
    config = path / "model.config"
    if not config.is_file():
        for name in ("model.sdf", "manifest.xml"):
            if (path / name).is_file() and name.endswith(".sdf"):
                return path / name
        raise FormatError("the folder has no model.config", file=str(path))
    root = xml.read_file(config)
    entries = [node for node in root.find_all("sdf") if node.text]
    if not entries:
        raise FormatError("a model.config needs an <sdf> element", source=root.source)
    name = max(entries, key=_rank).text
    if not can_be_path(name):
        raise FormatError("the <sdf> element does not hold a valid file name", source=root.source)
    file = (path / name).resolve()
    if not file.is_relative_to(path.resolve()):
        raise FormatError("the <sdf> must name a file in its own folder", source=root.source)
    return path / file.relative_to(path.resolve())


def _rank(node: Parameters) -> tuple[int, ...]:
    parts = node.attributes.get("version", "1.0").split(".")
    version = tuple(int(part) for part in parts if part.isdecimal() and len(part) <= _DIGITS)
    return version if version <= NEWEST else (0,)
