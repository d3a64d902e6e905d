"""Sub-commands, with those of ROS 1. Their modules are imported only when they are used."""

from __future__ import annotations

from gazelle_ros.cli.commands import COMMANDS as ROS_COMMANDS
from gazelle_ros.cli.commands import Command

_BEFORE = (
    Command(
        "demo", "train and evaluate a TurtleBot3 from its files", "start here", "gazelle.cli.demo"
    ),
    Command("run", "simulate a file", "simulate", "gazelle.cli.run"),
    Command(
        "check",
        "check files and report problems with file and line",
        "simulate",
        "gazelle.cli.check",
    ),
    Command("convert", "convert a file to another format", "simulate", "gazelle.cli.convert"),
    Command("map", "write a map_server map of a world", "simulate", "gazelle.cli.map"),
    Command(
        "view", "show a file or a running ROS graph in a browser", "visualize", "gazelle.cli.view"
    ),
    Command(
        "picture",
        "render an image of a world, recording, bag or policy",
        "visualize",
        "gazelle.cli.picture",
    ),
    Command("plot", "plot curves of runs, tables and bags", "visualize", "gazelle.cli.plot"),
    Command("film", "record a video as GIF or MP4", "visualize", "gazelle.cli.film"),
    Command("train", "train a policy for a task, or resume a run", "learn", "gazelle.cli.train"),
    Command(
        "eval",
        "measure success, collision and time-out rates of a run",
        "learn",
        "gazelle.cli.evaluate",
    ),
    Command(
        "new", "write a template of a task, or controllers for a robot", "learn", "gazelle.cli.new"
    ),
    Command(
        "study",
        "run a function over parameters and seeds into a table",
        "learn",
        "gazelle.cli.study",
    ),
    Command(
        "runs", "list the training runs of a folder, or import one", "learn", "gazelle.cli.runs"
    ),
    Command(
        "export",
        "write a policy as ONNX or arrays, or a run as one file",
        "learn",
        "gazelle.cli.export",
    ),
    Command("deploy", "drive a robot on a ROS 1 graph by a policy", "learn", "gazelle.cli.deploy"),
)
_AFTER = (
    Command(
        "shell", "open a shell with roscore, rostopic, rosrun ...", "ROS 1", "gazelle.cli.shell"
    ),
    Command("tasks", "list the tasks", "list and examine", "gazelle.cli.tasks"),
    Command("robots", "list the bundled robots", "list and examine", "gazelle.cli.robots"),
    Command("worlds", "list the bundled worlds", "list and examine", "gazelle.cli.worlds"),
    Command("plugins", "list the supported plugins", "list and examine", "gazelle.cli.plugins"),
    Command(
        "controllers",
        "list the supported controller types",
        "list and examine",
        "gazelle.cli.controllers",
    ),
    Command(
        "doctor",
        "diagnose this installation",
        "list and examine",
        "gazelle.cli.doctor",
    ),
    Command(
        "completion",
        "print tab completion for bash and zsh",
        "list and examine",
        "gazelle.cli.completion",
    ),
    Command("bench", "run the benchmarks of a source checkout", "measure", "gazelle.cli.bench"),
)
COMMANDS = {command.name: command for command in (*_BEFORE, *ROS_COMMANDS.values(), *_AFTER)}
