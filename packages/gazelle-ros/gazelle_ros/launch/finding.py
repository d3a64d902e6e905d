"""Find a launch file by package and name."""

from __future__ import annotations

import os
from pathlib import Path

from gazelle_ros.base.errors import did_you_mean
from gazelle_ros.launch.errors import LaunchError
from gazelle_ros.launch.packages import Packages

SUFFIXES = (".launch", ".launch.xml", ".test")
"""Ends of names of launch files."""


def find_launch_file(package: str, name: str, packages: Packages) -> Path:
    """Return the launch file of a package.

    ``name`` is a path in it, or a file's name anywhere in it.

    Raises:
        MissingPackageError: There is no such package.
        LaunchError: It has no such file, or several.
    """
    folder = packages.folder(package)
    if (folder / name).is_file():
        return folder / name
    known = _files(folder, name)
    found = known.get(name, [])
    if not found:
        raise LaunchError(
            f"package '{package}' has no launch file '{name}'", hint=did_you_mean(name, known)
        )
    if len(found) > 1:
        places = ", ".join(str(path.relative_to(folder)) for path in found)
        raise LaunchError(
            f"package '{package}' has several files '{name}': {places}",
            hint="give its path in the package",
        )
    return found[0]


def require_name(package: str, packages: Packages) -> None:
    """Raise an error if only a package is given, with the names of its launch files.

    Raises:
        LaunchError: There is such a package: one of its launch files must be named, too.
    """
    folder = packages.find(package)
    if folder is None:
        return
    files = ", ".join(sorted(_files(folder))) or "none"
    raise LaunchError(f"which launch file of the package '{package}'?", hint=f"it has: {files}")


def _files(folder: Path, name: str | None = None) -> dict[str, list[Path]]:
    """Return the launch files below a folder, and all of a name, by their names."""
    known: dict[str, list[Path]] = {}
    for place, folders, files in os.walk(folder):
        folders[:] = sorted(each for each in folders if not each.startswith("."))
        for file in files:
            if file == name or file.endswith(SUFFIXES):
                known.setdefault(file, []).append(Path(place, file))
    return known
