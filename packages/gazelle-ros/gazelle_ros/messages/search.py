"""Find packages on ROS_PACKAGE_PATH, and the definitions in them.

The rules are those of http://www.ros.org/reps/rep-0122.html and of rospack: folders are searched in
order, a folder with a ``package.xml`` is a package and is not searched further.
"""

from __future__ import annotations

import os
import warnings
from pathlib import Path

from gazelle_ros.base.errors import FormatWarning
from gazelle_ros.base.package_folders import package_folders, package_name
from gazelle_ros.messages.errors import InvalidDefinitionError
from gazelle_ros.messages.library import Definition, PackageDefinitions

_FOLDERS = (("msg", "msg"), ("srv", "srv"), ("action", "action"))

_crawled: dict[str, dict[str, Path]] = {}


def package_path() -> str:
    """Return the search path, as in ROS_PACKAGE_PATH."""
    return os.environ.get("ROS_PACKAGE_PATH", "")


def find_packages(path: str | None = None) -> dict[str, Path]:
    """Find the folders of all packages by name; the first of a name wins.

    Searched once for each path.

    Args:
        path: Folders with `os.pathsep` between them; by default ROS_PACKAGE_PATH.
    """
    path = package_path() if path is None else path
    if path not in _crawled:
        found: dict[str, Path] = {}
        for root in filter(None, path.split(os.pathsep)):
            for folder in package_folders(Path(root)):
                found.setdefault(package_name(folder), folder)
        _crawled[path] = found
    return _crawled[path]


def forget() -> None:
    """Search again at the next question."""
    _crawled.clear()


def read_definitions(folder: Path) -> PackageDefinitions:
    """Read all definitions in a package's folders, ``msg`` and so on, and in folders below.

    A malformed action is left out, and named.
    """
    found = PackageDefinitions()
    for name, kind in _FOLDERS:
        for file in sorted((folder / name).rglob(f"*.{kind}")):
            text = file.read_text(encoding="utf-8", errors="replace").replace("\r\n", "\n")
            try:
                found.add(kind, file.stem, Definition(text, str(file)))
            except InvalidDefinitionError as err:
                warnings.warn(str(err), FormatWarning, stacklevel=2)
    return found
