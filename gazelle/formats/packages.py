"""ROS packages and Gazebo models on disk: which folders hold them."""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from gazelle.errors import FormatError
from gazelle.formats import xml

MAX_DEPTH = 5
MAX_FOLDERS = 5_000

_SKIPPED = {"node_modules", "__pycache__", "site-packages", "build", "install", "log", "venv"}


@dataclass(slots=True)
class Index:
    """What a search below one folder found, by name."""

    packages: dict[str, Path] = field(default_factory=dict)
    models: dict[str, Path] = field(default_factory=dict)


def scan(root: Path) -> Index:
    """All packages and models up to ``MAX_DEPTH`` folders below ``root``, shallow ones first.

    Links to folders are not followed, so that the search ends and stays below ``root``.
    """
    index = Index()
    level = [root]
    seen = 0
    for _ in range(MAX_DEPTH + 1):
        following: list[Path] = []
        for folder in level:
            seen += 1
            if seen > MAX_FOLDERS:
                return index
            names, folders = _list(folder)
            if "package.xml" in names:
                index.packages.setdefault(package_name(folder), folder)
            if "model.config" in names:
                index.models.setdefault(folder.name, folder)
            following.extend(folders)
        level = following
    return index


def _list(folder: Path) -> tuple[set[str], list[Path]]:
    names: set[str] = set()
    folders: list[Path] = []
    try:
        with os.scandir(folder) as entries:
            for entry in sorted(entries, key=lambda e: e.name):
                if not entry.is_dir(follow_symlinks=False):
                    names.add(entry.name)
                elif not entry.name.startswith(".") and entry.name not in _SKIPPED:
                    folders.append(Path(entry.path))
    except OSError:
        return set(), []
    return names, folders


def package_name(folder: Path) -> str:
    """The name in a folder's ``package.xml``, or the folder's own where it has none."""
    try:
        root = xml.read_file(folder / "package.xml")
    except FormatError:
        return folder.name
    name = root.find("name")
    return name.text if name is not None and name.text else folder.name


def exported_model_paths(package: Path) -> Iterator[Path]:
    """Folders that a package exports to Gazebo as places of models.

    These are the ``gazebo_model_path`` attributes of ``<export><gazebo_ros>``.
    """
    try:
        root = xml.read_file(package / "package.xml")
    except FormatError:
        return
    export = root.find("export")
    if export is None:
        return
    for element in export.find_all("gazebo_ros"):
        for part in element.attributes.get("gazebo_model_path", "").split(":"):
            if part:
                yield Path(part.replace("${prefix}", str(package)))
