"""The ``xacro`` program, with packages found as ROS 1 finds them."""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from gazelle.errors import MissingExtraError, RosError
from gazelle.ros.launch.packages import Packages

_NO_EFFECT = {"--inorder", "-i", "--xacro-ns"}
"""Options of older versions that ask for what is usual now."""


def main(arguments: Sequence[str]) -> int:
    """Expand a file to standard output, or to that of ``-o``; returns the exit code."""
    xacro = _xacro()
    # Spawners pass on what roslaunch gave them, such as __name:=.
    kept = [each for each in arguments if each not in _NO_EFFECT and not each.startswith("__")]
    sys.argv = ["xacro", *kept]
    try:
        xacro.main()
    except SystemExit as stop:
        return stop.code if isinstance(stop.code, int) else 1 if stop.code else 0
    return 0


def expand(file: str | Path, arguments: Mapping[str, str]) -> str:
    """The text of a file with xacro expanded.

    Args:
        file: URDF with or without xacro.
        arguments: Values of its ``<xacro:arg>``.

    Raises:
        RosError: It cannot be expanded.
    """
    xacro = _xacro()
    try:
        document = xacro.process_file(str(file), mappings=dict(arguments))
    except Exception as error:
        raise RosError(f"xacro cannot expand it: {error}", file=str(file)) from error
    return str(document.toprettyxml(indent="  "))


def _xacro() -> Any:
    """The package, which finds what ``$(find ...)`` names as ROS 1 does."""
    try:
        import xacro
        from xacro import substitution_args
    except ImportError:
        raise MissingExtraError("xacro", "ros") from None
    packages = Packages()

    def find(package: str) -> str:
        return str(packages.folder(package))

    # The package looks for ROS 2 packages and has no other way to be told.
    looked_up: Any = substitution_args
    looked_up._eval_find = find  # noqa: SLF001
    looked_up._eval_dict["find"] = find  # noqa: SLF001
    return xacro
