"""Helper functions for scripts that launch."""

from __future__ import annotations

import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from gazelle_ros import names, net
from gazelle_ros.base.errors import Error
from gazelle_ros.compat.roslaunch.core import RLException, generate_run_id
from gazelle_ros.compat.roslaunch.plans import load_plan
from gazelle_ros.errors import ApiError, RosError
from gazelle_ros.launch.finding import find_launch_file
from gazelle_ros.launch.packages import Packages
from gazelle_ros.launch.programs import find_program
from gazelle_ros.master.proxy import MasterProxy

_LOOK_S = 0.1


def resolve_launch_arguments(args: Sequence[str]) -> list[str]:
    """Return paths of launch files: ``[PKG, FILE]`` becomes ``[PATH]``.

    Raises:
        RLException: There is no such file.
    """
    words = [word for word in args if not names.split_arguments([word])[1]]
    if not words:
        return []
    if len(words) >= 2:
        packages = Packages()
        try:
            return [str(find_launch_file(words[0], words[1], packages)), *words[2:]]
        except Error as error:
            if not Path(words[0]).is_file():
                raise RLException(str(error)) from None
    if words[0] != "-" and not Path(words[0]).is_file():
        raise RLException(f"[{words[0]}] is not a launch file name")
    return words


def get_or_generate_uuid(options_runid: str | None, options_wait_for_master: Any) -> str:
    """Return the name of the run: the one given, that of the master, or a new one.

    Args:
        options_runid: It, if it is known.
        options_wait_for_master: Wait for a master to say it.
    """
    if options_runid:
        return options_runid
    proxy = MasterProxy(net.default_master_uri(), "/roslaunch")
    try:
        while True:
            try:
                return str(proxy.get_param("/run_id"))
            except ApiError:
                return generate_run_id()  # a bare master, which has none
            except RosError:
                if not options_wait_for_master:
                    return generate_run_id()
            time.sleep(_LOOK_S)
    finally:
        proxy.close()


def check_roslaunch(
    f: str,
    use_test_depends: bool = False,  # noqa: FBT001, FBT002  # roslaunch's interface
    ignore_unset_args: bool = False,  # noqa: FBT001, FBT002
) -> str | None:
    """Return the errors of a launch file and its nodes as text; None without any."""
    del use_test_depends, ignore_unset_args
    packages = Packages()
    errors = []
    try:
        plan = load_plan([f])
    except Error as error:
        return str(error)
    for node in [*plan.nodes, *plan.tests]:
        try:
            find_program(node, packages)
        except Error as error:
            errors.append(str(error))
    return "\n".join(errors) or None


def print_file_list(roslaunch_files: list[Any]) -> None:
    """Write the files that are read to the screen."""
    import sys

    sys.stdout.write("".join(f"{file}\n" for file in load_plan(roslaunch_files).files))


def check_log_disk_usage() -> None:
    """Do nothing: logs are small here."""


def update_terminal_name(ros_master_uri: str) -> None:
    """Do nothing: the terminal keeps its title."""
    del ros_master_uri


def change_terminal_name(args: Sequence[str], is_core: Any) -> None:
    """Do nothing: the terminal keeps its title."""
    del args, is_core
