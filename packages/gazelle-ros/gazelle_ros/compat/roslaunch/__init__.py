"""roslaunch's interface: launch files and nodes from a script.

Nodes run on this machine only, and are Gazelle's processes: child launchers on other machines are not here.
"""

from __future__ import annotations

from collections.abc import Sequence

from gazelle_ros.compat import commands
from gazelle_ros.compat.roslaunch import (
    arg_dump,
    config,
    core,
    nodeprocess,
    parent,
    pmon,
    rlutil,
    scriptapi,
    substitution_args,
    xmlloader,
)
from gazelle_ros.compat.roslaunch.config import ROSLaunchConfig
from gazelle_ros.compat.roslaunch.core import Machine, Master, Node, Param, RLException, Test
from gazelle_ros.compat.roslaunch.nodeprocess import (
    DEFAULT_TIMEOUT_SIGINT,
    DEFAULT_TIMEOUT_SIGTERM,
)
from gazelle_ros.compat.roslaunch.pmon import Process
from gazelle_ros.compat.roslaunch.scriptapi import ROSLaunch
from gazelle_ros.compat.roslaunch.xmlloader import XmlLoader, XmlParseException
from gazelle_ros.compat.rosmaster.master import DEFAULT_MASTER_PORT
from gazelle_ros.compat.rosmaster.master_api import NUM_WORKERS

__all__ = [
    "DEFAULT_MASTER_PORT",
    "DEFAULT_TIMEOUT_SIGINT",
    "DEFAULT_TIMEOUT_SIGTERM",
    "NAME",
    "NUM_WORKERS",
    "Machine",
    "Master",
    "Node",
    "Param",
    "Process",
    "RLException",
    "ROSLaunch",
    "ROSLaunchConfig",
    "Test",
    "XmlLoader",
    "XmlParseException",
    "arg_dump",
    "config",
    "configure_logging",
    "core",
    "main",
    "nodeprocess",
    "parent",
    "pmon",
    "rlutil",
    "scriptapi",
    "substitution_args",
    "xmlloader",
]

NAME = "roslaunch"


def configure_logging(uuid: str) -> None:
    """Do nothing: Gazelle's launcher needs no set-up of its logs."""
    del uuid


def main(argv: Sequence[str] | None = None) -> None:
    """Run the command ``roslaunch`` with a command line, by default this process's.

    It returns when the launch has ended, as roslaunch's does.

    Raises:
        SystemExit: It failed; the code is that of the command.
    """
    commands.run("launch", argv)
