"""Sub-commands. Their modules are imported only when they are used."""

from __future__ import annotations

import argparse
import importlib
from dataclasses import dataclass
from typing import Protocol, cast


class CommandModule(Protocol):
    """Interface of a sub-command's module."""

    def configure(self, parser: argparse.ArgumentParser) -> None:
        """Declare the arguments."""

    def run(self, args: argparse.Namespace) -> int:
        """Run the command; returns the exit code."""


@dataclass(frozen=True, slots=True)
class Command:
    """A sub-command."""

    name: str
    """Name as typed by the user."""
    purpose: str
    """One line for ``--help``."""
    group: str
    """Headline it stands under."""
    module: str
    """Full name of its module."""
    text: str = ""
    """Head of its help; by default the docstring of its module."""

    def load(self) -> CommandModule:
        """Import its module."""
        return cast("CommandModule", importlib.import_module(self.module))


_SRV = """List and show service types, as rossrv does.

  gazelle srv list
  gazelle srv show std_srvs/SetBool
  gazelle srv md5 gazebo_msgs/SpawnModel
"""

COMMANDS = {
    command.name: command
    for command in (
        Command(
            "master",
            "run a ROS 1 master with parameters and rosout",
            "ROS 1",
            "gazelle_ros.cli.master",
        ),
        Command("launch", "run a roslaunch file", "ROS 1", "gazelle_ros.cli.launch"),
        Command(
            "exec", "run a Python script written for ROS 1", "ROS 1", "gazelle_ros.cli.execute"
        ),
        Command(
            "topic", "list, show, publish and measure topics", "ROS 1", "gazelle_ros.cli.topic"
        ),
        Command("service", "list, show and call services", "ROS 1", "gazelle_ros.cli.service"),
        Command("node", "list, show, ping and stop nodes", "ROS 1", "gazelle_ros.cli.node"),
        Command("param", "get, set, load and dump parameters", "ROS 1", "gazelle_ros.cli.param"),
        Command(
            "bridge",
            "connect WebSocket clients to the graph, as rosbridge",
            "ROS 1",
            "gazelle_ros.cli.bridge",
        ),
        Command("bag", "record, play and inspect bag files", "ROS 1", "gazelle_ros.cli.bag"),
        Command("msg", "list and show message types", "ROS 1", "gazelle_ros.cli.messages"),
        Command("srv", "list and show service types", "ROS 1", "gazelle_ros.cli.messages", _SRV),
    )
}
