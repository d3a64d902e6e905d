"""The flag ``--moveit``: MoveIt's node for the robot that runs, with its controllers at work."""

from __future__ import annotations

import argparse
import contextlib
import os
import signal
import subprocess
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gazelle.cli.description_publisher import urdf_of
from gazelle.errors import ControlError, ResolveError
from gazelle_ros.base import bounded_yaml
from gazelle_ros.base.child_processes import child_process
from gazelle_ros.base.text_files import read_text

if TYPE_CHECKING:
    from gazelle.bridges import RosServer
    from gazelle.simulation import Robot, Simulation

_CONTROLLERS = (
    "package://{0}_control/config/{0}_control.yaml",
    "package://{0}_control/config/{0}_controllers.yaml",
    "package://{0}_gazebo/config/default_controllers.yaml",
)
_PATIENCE_S = 20.0


def add_moveit(parser: argparse.ArgumentParser) -> None:
    """Declare the flags."""
    parser.add_argument(
        "--controllers",
        metavar="FILE",
        help="load the controllers of a YAML file for the last robot, and start those whose "
        "joints are free",
    )
    parser.add_argument(
        "--moveit",
        action="store_true",
        help="with --ros: also start the move_group.launch of the last robot's package "
        "ROBOT_moveit_config, and its controllers (by default those of ROBOT_control or "
        "ROBOT_gazebo)",
    )


def start_requested_controllers(sim: Simulation, args: argparse.Namespace) -> None:
    """Load and start controllers on request.

    Raises:
        ResolveError: A file or package is not there.
        ControlError: The file names no controllers, or one cannot be loaded.
    """
    if args.controllers is None and not args.moveit:
        return
    robot = _planned(sim)[0] if args.moveit else _last(sim)
    file = Path(args.controllers) if args.controllers is not None else _controllers_of(robot)
    _start(robot, file, verbose=args.verbose)


@contextmanager
def running_moveit(sim: Simulation, server: RosServer, args: argparse.Namespace) -> Iterator[None]:
    """Run MoveIt's node beside the simulation, if requested.

    Raises:
        ResolveError: No robot has a package for MoveIt.
    """
    if not args.moveit:
        yield
        return
    robot, package = _planned(sim)
    server.node.set_param("/robot_description", _description(robot))
    command = [sys.executable, "-m", "gazelle", "launch", package, "move_group.launch"]
    environ = {**os.environ, "ROS_MASTER_URI": server.master_uri}
    # The summary of its parameters would hide what this command prints; errors go to stderr.
    quiet = subprocess.DEVNULL
    with child_process(command, env=environ, stdout=quiet) as beside:
        try:
            yield
        finally:
            beside.send_signal(signal.SIGINT)
            with contextlib.suppress(subprocess.TimeoutExpired):
                beside.wait(_PATIENCE_S)


def _last(sim: Simulation) -> Robot:
    robots = list(sim.robots.values())
    if not robots:
        raise ResolveError("there is no robot to control", hint="name one, or use --spawn")
    return robots[-1]


def _planned(sim: Simulation) -> tuple[Robot, str]:
    """Return the last robot that has a package for MoveIt, and the package."""
    for robot in reversed(list(sim.robots.values())):
        for name in dict.fromkeys((robot.description.name, robot.name)):
            package = f"{name}_moveit_config"
            if _find(robot, f"package://{package}/launch/move_group.launch") is not None:
                return robot, package
    raise ResolveError(
        "no robot here has a package ROBOT_moveit_config with launch/move_group.launch",
        hint="its folder must be on ROS_PACKAGE_PATH; the robot 'fetch' comes with one",
    )


def _controllers_of(robot: Robot) -> Path:
    tried = [form.format(robot.description.name) for form in _CONTROLLERS]
    found = next((path for uri in tried if (path := _find(robot, uri)) is not None), None)
    if found is None:
        raise ResolveError(
            f"no controllers of '{robot.name}' were found ({', '.join(tried)})",
            hint="name their file: --controllers FILE",
        )
    return found


def _find(robot: Robot, uri: str) -> Path | None:
    from gazelle.formats import Resolver

    source = robot.description.source
    return Resolver(file=Path(source.file) if source and source.file else None).find(uri)


def _start(robot: Robot, file: Path, *, verbose: bool) -> None:
    """Load all controllers of a file; those whose joints others have claimed do not run."""
    import yaml

    try:
        given: Any = bounded_yaml.safe_load(read_text(file))
    except OSError as error:
        raise ResolveError(f"cannot read {file}: {error.strerror}") from error
    except yaml.YAMLError as error:
        raise ControlError(f"{file} is not valid YAML: {error}") from error
    if not isinstance(given, Mapping):
        raise ControlError(f"{file} has no controllers", hint="names, each with type and joints")
    configured = {
        name: each for name, each in given.items() if isinstance(each, Mapping) and "type" in each
    }
    if not configured:
        raise ControlError(f"{file} has no controllers", hint="names, each with type and joints")
    idle: dict[str, str] = {}
    for name, parameters in configured.items():
        robot.controllers.load(name, parameters)
        try:
            robot.controllers.start(name)
        except ControlError as error:
            idle[name] = error.message
    if verbose:
        sys.stdout.writelines(f"'{name}' is not started: {why}\n" for name, why in idle.items())
    elif idle:
        sys.stdout.write(f"controllers not started (--verbose says why): {', '.join(idle)}\n")


def _description(robot: Robot) -> str:
    text = urdf_of(robot)
    if text is None:
        raise ResolveError(
            f"--moveit needs a robot from a URDF file, and '{robot.name}' is from another format"
        )
    return text
