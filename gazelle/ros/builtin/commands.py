"""Command-line tools as nodes of a launch file, such as ``rostopic pub``."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Sequence

from gazelle.ros import names
from gazelle.ros.tools.watching import NODE_NAME


def topic(arguments: Sequence[str]) -> int:
    """Do what rostopic does; returns the exit code."""
    return run_command("topic", arguments)


def service(arguments: Sequence[str]) -> int:
    """Do what rosservice does; returns the exit code."""
    return run_command("service", arguments)


def param(arguments: Sequence[str]) -> int:
    """Do what rosparam does; returns the exit code."""
    return run_command("param", arguments)


def run_command(tool: str, arguments: Sequence[str]) -> int:
    """Run a command of Gazelle's without what roslaunch adds to a node's command line."""
    plain, mappings = names.split_arguments(arguments)
    command = [sys.executable, "-m", "gazelle.cli.main", tool, *plain]
    environment = {**os.environ, NODE_NAME: mappings.get("__name", "")}
    if os.name == "posix":
        # In place of this process, so that signals reach the tool itself.
        os.execve(sys.executable, command, environment)  # noqa: S606  # our own program
    return subprocess.call(command, env=environment)  # noqa: S603  # our own program
