"""``rospack find PACKAGE`` and ``rospack list``, for scripts that look for packages."""

from __future__ import annotations

import sys
from collections.abc import Sequence

from gazelle_ros.errors import RosError
from gazelle_ros.launch.packages import Packages


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
            for name, folder in packages.folders().items():
                sys.stdout.write(f"{name} {folder}\n")
        case ["list-names"]:
            sys.stdout.writelines(f"{name}\n" for name in packages.folders())
        case _:
            raise RosError(
                f"rospack {' '.join(arguments)} is not understood",
                hint="there are: rospack find PACKAGE, rospack list, rospack list-names",
            )
    return 0
