"""ROS packages that are bundled as folders, and their files by the paths that their namesakes publish.

A manifest says what stands for a file that is elsewhere, and what is like one that is not bundled::

    <export>
      <gazelle>
        <file path="worlds/empty.world" at="../worlds/empty.world"/>
        <missing path="worlds/house.world" see="worlds/flat.world"/>
      </gazelle>
    </export>
"""

from __future__ import annotations

import functools
import os
import xml.etree.ElementTree as ET
from importlib.util import find_spec
from pathlib import Path

from gazelle_ros.base.entry_points import entry_points_of
from gazelle_ros.base.errors import closest_of
from gazelle_ros.base.path_texts import can_be_path

_NAMED = 6


GROUP = "gazelle_ros.packages"
"""Entry points of Python packages with folders of ROS packages, as ``gazelle.assets``."""


@functools.cache
def roots() -> tuple[Path, ...]:
    """Return the folders of ROS packages of installed distributions."""
    specs = (find_spec(point.value) for point in entry_points_of(GROUP).values())
    places = (spec.submodule_search_locations or () for spec in specs if spec is not None)
    return tuple(Path(place) for found in places for place in found)


def bundled_folders() -> dict[str, Path]:
    """Return the folders of the packages by name: every folder with a manifest."""
    found = sorted(file for root in roots() for file in root.glob("*/package.xml"))
    return {manifest.parent.name: manifest.parent for manifest in found}


def published(path: str | os.PathLike[str], root: Path | None = None) -> Path:
    """Return the bundled file that a path stands for; the path itself where there is none.

    Args:
        path: A path that may lie in a bundled package.
        root: The folder of the packages; by default all that are registered.
    """
    given = Path(path)
    place = _place(given, root)
    if place is None:
        return given
    for name, at in _entries(place[0], "file", "at"):
        inner = _below(name, place[1])
        if inner is not None:
            return Path(os.path.normpath(place[0] / at / inner))
    return given


def published_hint(path: str | os.PathLike[str]) -> str | None:
    """Return what is bundled in place of a file that is not; None outside of bundled packages."""
    given = Path(path)
    place = _place(given, None)
    if place is None:
        return None
    package, inner = place
    said = f"the {package.name} that comes with Gazelle holds less than its namesake"
    for name, see in _entries(package, "missing", "see"):
        if _below(name, inner) is not None:
            return f"{said}: see {see}"
    parent = given.parent
    while not parent.is_dir():
        parent = parent.parent
    names = sorted(each.name for each in parent.iterdir() if each.name != "package.xml")
    close = closest_of(given.name, names)
    more = ", ..." if len(names) > _NAMED else ""
    here = parent.relative_to(package.parent)
    listed = f"{here} has {', '.join(names[:_NAMED])}{more}" if names else f"{here} is empty"
    return f"{said}: {close or listed}; put the folder of yours on ROS_PACKAGE_PATH to use that"


def _place(path: Path, root: Path | None) -> tuple[Path, str] | None:
    """Return the package that a path without a file lies in, and the path in it."""
    plain = Path(os.path.normpath(path))
    if not can_be_path(plain):
        return None
    places = roots() if root is None else (root,)
    root = next((each for each in places if plain.is_relative_to(each)), None)
    if root is None or plain.exists():
        return None
    name, *inner = plain.relative_to(root).parts
    package = root / name
    return (package, "/".join(inner)) if (package / "package.xml").is_file() else None


def _below(name: str, path: str) -> str | None:
    """Return what follows a name in a path; None if it does not begin with it."""
    if path == name:
        return ""
    return path[len(name) + 1 :] if path.startswith(f"{name}/") else None


@functools.cache
def _entries(package: Path, tag: str, value: str) -> list[tuple[str, str]]:
    """Return the paths in a package's manifest, and what it says of each."""
    manifest = ET.parse(package / "package.xml")  # noqa: S314  # a file of our own
    found = manifest.findall(f"export/gazelle/{tag}")
    return [(each.attrib["path"], each.attrib[value]) for each in found]
