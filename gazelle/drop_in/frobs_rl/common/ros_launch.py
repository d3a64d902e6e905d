"""Start launch files; they end with the script."""

from __future__ import annotations

from collections.abc import Sequence

from gazelle.drop_in.frobs_rl.common.connection import reporting, xacro_arguments
from gazelle.drop_in.shared import background


@reporting
def ros_launch_from_pkg(
    pkg_name: str,
    launch_file: str,
    args: Sequence[str] | None = None,
    launch_new_term: bool = True,  # noqa: FBT001, FBT002  # frobs_rl's interface
) -> None:
    """Start a launch file of a package.

    Args:
        pkg_name: The package.
        launch_file: The file in it.
        args: Such as ``["gui:=false"]``.
        launch_new_term: Taken; nothing here needs a terminal.
    """
    del launch_new_term
    background.processes().start_launch(
        launch_file, package=pkg_name, arguments=xacro_arguments(args)
    )


@reporting
def ros_launch_from_path(
    launch_file_path: str,
    args: Sequence[str] | None = None,
    launch_new_term: bool = True,  # noqa: FBT001, FBT002
) -> None:
    """Start a launch file."""
    del launch_new_term
    background.processes().start_launch(launch_file_path, arguments=xacro_arguments(args))


def ros_kill_launch_process() -> bool:
    """Stop all launch files and nodes that this script has started; returns True."""
    background.stop_all()
    return True
