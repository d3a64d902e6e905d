"""``rospack find PACKAGE`` and ``rospack list``, for scripts that ask where packages are."""

from __future__ import annotations

import sys
from collections.abc import Sequence

from gazelle_ros.builtin import registry
from gazelle_ros.errors import RosError
from gazelle_ros.launch.packages import Packages
from gazelle_ros.messages.search import find_packages


def main(arguments: Sequence[str]) -> int:
    """Run rospack's ``find``, ``list`` and ``list-names``; returns the exit code.

    Raises:
        RosError: There is no such package or command.
    """
    packages = Packages()
    match list(arguments):
        case ["find", name]:
            sys.stdout.write(f"{packages.folder(name)}\n")
        case ["list"]:
            for name, folder in _all(packages).items():
                sys.stdout.write(f"{name} {folder}\n")
        case ["list-names"]:
            sys.stdout.writelines(f"{name}\n" for name in _all(packages))
        case _:
            raise RosError(
                f"rospack {' '.join(arguments)} is not understood",
                hint="there are: rospack find PACKAGE, rospack list, rospack list-names",
            )
    return 0


def _all(packages: Packages) -> dict[str, str]:
    """Return the folder of each package that has one, by name."""
    found = {name: str(folder) for name, folder in find_packages(packages.path).items()}
    for name in registry.packages():
        known = registry.package(name)
        if known is not None and known.folder is not None:
            found.setdefault(name, str(known.folder))
    return dict(sorted(found.items()))
