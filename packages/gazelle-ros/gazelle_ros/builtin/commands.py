"""Command-line tools as nodes of a launch file, such as ``rostopic pub``."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence

from gazelle_ros import names
from gazelle_ros.base.child_processes import become
from gazelle_ros.tools.watching import NODE_NAME


def topic(arguments: Sequence[str]) -> int:
    """Run rostopic's command line; returns the exit code."""
    return run_command("topic", arguments)


def service(arguments: Sequence[str]) -> int:
    """Run rosservice's command line; returns the exit code."""
    return run_command("service", arguments)


def param(arguments: Sequence[str]) -> int:
    """Run rosparam's command line; returns the exit code."""
    return run_command("param", arguments)


def run_command(tool: str, arguments: Sequence[str]) -> int:
    """Run a command of Gazelle's without what roslaunch adds to a node's command line."""
    plain, mappings = names.split_arguments(arguments)
    command = [sys.executable, "-m", "gazelle_ros.cli.main", tool, *plain]
    environment = {**os.environ, NODE_NAME: mappings.get("__name", "")}
    return become(command, environment)
