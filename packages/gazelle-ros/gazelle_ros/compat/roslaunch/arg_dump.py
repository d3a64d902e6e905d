"""The arguments that launch files take."""

from __future__ import annotations

import sys
from collections.abc import Sequence

from gazelle_ros.compat.roslaunch.core import RLException
from gazelle_ros.launch import describing
from gazelle_ros.launch.errors import LaunchError
from gazelle_ros.launch.loader import declared_arguments
from gazelle_ros.launch.plan import LaunchPlan


def get_args(roslaunch_files: Sequence[str]) -> dict[str, tuple[str | None, str | None]]:
    """Return documentation and default values of the arguments, by name.

    Raises:
        RLException: A file is malformed.
    """
    return {
        each.name: (each.doc or None, each.default)
        for each in _plan(roslaunch_files).arguments.values()
        if not each.constant
    }


def dump_args(roslaunch_files: Sequence[str]) -> None:
    """Write them to standard output.

    Raises:
        RLException: A file is malformed.
    """
    sys.stdout.write(describing.arguments(_plan(roslaunch_files)))


def _plan(files: Sequence[str]) -> LaunchPlan:
    try:
        return declared_arguments(list(files), {})
    except LaunchError as error:
        raise RLException(str(error)) from None
