"""ROS packages and Gazebo models on disk: which folders hold them."""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from gazelle.errors import FormatError
from gazelle.formats import xml
from gazelle_ros.base.package_folders import (
    IGNORED,
    MANIFESTS,
    NOT_DEEPER,
    package_folders,
    package_name,
)

MAX_DEPTH = 5
MAX_FOLDERS = 5_000

_SKIPPED = {"node_modules", "__pycache__", "site-packages", "build", "install", "log", "venv"}


Listing = tuple[set[str], list[Path]]
"""Names of the files in a folder, and the folders in it."""


@dataclass(slots=True)
class Index:
    """Result of a search below one folder.

    Attributes:
        models: Folders of models by name.
        package_folders: Folders of packages; their names are read on demand.
    """

    models: dict[str, Path] = field(default_factory=dict)
    package_folders: list[Path] = field(default_factory=list)
    _packages: dict[str, Path] | None = None

    @property
    def packages(self) -> dict[str, Path]:
        """Folders of packages by name."""
        if self._packages is None:
            self._packages = {}
            for folder in self.package_folders:
                self._packages.setdefault(package_name(folder), folder)
        return self._packages


def scan(root: Path, listings: dict[Path, Listing]) -> Index:
    """Return all packages and models up to ``MAX_DEPTH`` folders below ``root``, shallow first.

    Links to folders are not followed, so that the search ends and stays below ``root``.

    Args:
        root: Start of the search.
        listings: Known folders; new ones are added.
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
            if folder not in listings:
                listings[folder] = _list(folder)
            names, folders = listings[folder]
            if "package.xml" in names:
                index.package_folders.append(folder)
            if "model.config" in names:
                index.models.setdefault(folder.name, folder)
            following.extend(folders)
        level = following
    return index


def crawl(root: Path) -> dict[str, Path]:
    """Return the packages below a folder of ``ROS_PACKAGE_PATH``, by rospack's rules.

    Depth first; a package is not searched further, nor are a folder with ``CATKIN_IGNORE``, one
    with ``rospack_nosubdirs`` and hidden ones. Links are followed. The first of a name wins; which
    that is rospack leaves to the file system, here folders go by the alphabet.
    """
    found: dict[str, Path] = {}
    for folder in package_folders(root, most=MAX_FOLDERS):
        found.setdefault(package_name(folder), folder)
    return found


def is_package(folder: Path, name: str) -> bool:
    """Return whether a folder holds the package of that name and is not marked to be ignored."""
    ignored = (folder / IGNORED).exists()
    return not ignored and (folder / "package.xml").is_file() and package_name(folder) == name


def is_searched(folder: Path) -> bool:
    """Return whether packages are searched below a folder: it is neither a package nor excluded."""
    stops = (IGNORED, NOT_DEEPER, *MANIFESTS)
    return not any((folder / name).exists() for name in stops)


def _list(folder: Path) -> Listing:
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


def exported_model_paths(package: Path) -> Iterator[Path]:
    """Yield folders that a package exports to Gazebo as places of models.

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
