"""Where packages are below a folder of ROS_PACKAGE_PATH, by rospack's rules.

The rules are those of http://www.ros.org/reps/rep-0122.html and of rospack.
"""

from __future__ import annotations

import math
import os
from collections.abc import Iterator
from pathlib import Path

IGNORED = "CATKIN_IGNORE"
NOT_DEEPER = "rospack_nosubdirs"
MANIFESTS = frozenset({"package.xml", "manifest.xml"})

_DEEPEST = 12


def package_folders(root: Path, *, most: float = math.inf) -> Iterator[Path]:
    """The packages below a folder, depth first, folders by the alphabet.

    A package is not searched further, nor are a folder with ``CATKIN_IGNORE``, one with
    ``rospack_nosubdirs`` and hidden ones. Links are followed.

    Args:
        root: Where to begin; it may be a package itself.
        most: How many folders are looked into at most.
    """
    return _below(root, _DEEPEST, set(), most)


def _below(folder: Path, depth: int, seen: set[str], most: float) -> Iterator[Path]:
    real = os.path.realpath(folder)
    if real in seen or len(seen) >= most:  # links may lead in circles
        return
    seen.add(real)
    try:
        with os.scandir(folder) as entries:
            listed = sorted(entries, key=lambda entry: entry.name)
    except OSError:
        return
    names = {entry.name for entry in listed}
    if IGNORED in names:
        return
    if not MANIFESTS.isdisjoint(names):
        yield folder
        return
    if depth == 0 or NOT_DEEPER in names:
        return
    for entry in listed:
        if entry.name[0] != "." and entry.is_dir():
            yield from _below(Path(entry.path), depth - 1, seen, most)
