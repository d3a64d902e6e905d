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
    """One line for ``gazelle --help``."""
    group: str
    """Headline it stands under."""
    module: str
    """Name of its module in this package."""

    def load(self) -> CommandModule:
        """Import its module."""
        return cast("CommandModule", importlib.import_module(f"gazelle.cli.{self.module}"))


COMMANDS = {
    command.name: command
    for command in (
        Command("demo", "train and evaluate a TurtleBot3 from its files", "start here", "demo"),
        Command("run", "simulate a file", "simulate", "run"),
        Command("check", "check files: every problem, with file and line", "simulate", "check"),
        Command("convert", "files from one format to another", "simulate", "convert"),
        Command("map", "the true map of a world, for map_server", "simulate", "map"),
        Command("view", "a file, or a running ROS graph, live in a browser", "look", "view"),
        Command("picture", "draw a world, a recording, a bag, a policy", "look", "picture"),
        Command("plot", "curves, tables and bags as plots", "look", "plot"),
        Command("film", "film them: GIF, MP4", "look", "film"),
        Command("train", "train a policy for a task, or go on with a run", "learn", "train"),
        Command("eval", "success, collision and time-out rates of a run", "learn", "evaluate"),
        Command("new", "a task of your own; controllers for a robot", "learn", "new"),
        Command("study", "many parameters and seeds, in one table", "learn", "study"),
        Command("runs", "the training runs of a folder in one table", "learn", "runs"),
        Command("export", "a run's policy as ONNX or numpy arrays", "learn", "export"),
        Command("deploy", "let a policy drive a robot on a ROS 1 graph", "learn", "deploy"),
        Command("master", "run a ROS 1 master with parameters and rosout", "ROS 1", "master"),
        Command("launch", "run a roslaunch file", "ROS 1", "launch"),
        Command("exec", "run a Python script written for ROS 1", "ROS 1", "execute"),
        Command("shell", "a shell with roscore, rostopic, rosrun ...", "ROS 1", "shell"),
        Command("topic", "list, show, publish and measure topics", "ROS 1", "topic"),
        Command("service", "list, show and call services", "ROS 1", "service"),
        Command("node", "list, show, ping and end nodes", "ROS 1", "node"),
        Command("param", "get, set, load and dump parameters", "ROS 1", "param"),
        Command("bridge", "rosbridge: the graph for WebSocket clients", "ROS 1", "bridge"),
        Command("bag", "record, play and inspect bag files", "ROS 1", "bag"),
        Command("msg", "show messages: fields, MD5 sums", "ROS 1", "messages"),
        Command("srv", "show services: fields, MD5 sums", "ROS 1", "messages"),
        Command("tasks", "list the tasks", "what there is", "tasks"),
        Command("robots", "list the bundled robots", "what there is", "robots"),
        Command("worlds", "list the bundled worlds", "what there is", "worlds"),
        Command("plugins", "list the supported plugins", "what there is", "plugins"),
        Command("controllers", "list the types of controllers", "what there is", "controllers"),
        Command(
            "doctor", "this machine: what works and what is missing", "what there is", "doctor"
        ),
        Command("completion", "tab completion for bash and zsh", "what there is", "completion"),
        Command("bench", "run the benchmarks of a source checkout", "measure", "bench"),
    )
}
