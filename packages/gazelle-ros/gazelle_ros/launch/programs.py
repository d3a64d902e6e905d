"""From a node of a plan to the command line that runs it."""

from __future__ import annotations

import os
import re
import shlex
import shutil
import subprocess
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from gazelle_ros.base.child_processes import child_process
from gazelle_ros.base.errors import Error
from gazelle_ros.builtin import on_path, registry, terminal
from gazelle_ros.launch.errors import LaunchError
from gazelle_ros.launch.limits import communicate
from gazelle_ros.launch.packages import Packages, is_python
from gazelle_ros.launch.plan import LaunchParameter, NodePlan, ParameterCommand
from gazelle_ros.launch.values import convert

_EXECUTE = (sys.executable, "-m", "gazelle_ros.cli.main", "exec")
"""Runs a script with ``import rospy`` and its like answered by Gazelle."""
_BUILTIN = (sys.executable, "-m", "gazelle_ros.builtin.start")
_TERMINAL = (sys.executable, "-m", "gazelle_ros.builtin.terminal")
PYTHON = re.compile(r"(?:.*/)?python[\d.]*")
"""Names of the interpreter, which Python scripts have anyway."""
XACRO = {"xacro", "xacro.py"}
"""Names of xacro's program in commands of parameters."""
_COMMAND_SECONDS = 120.0


@dataclass(frozen=True, slots=True)
class Program:
    """Command for a node."""

    command: tuple[str, ...]
    """Without the node's own arguments."""
    folder: Path | None
    """Folder of the program; None for built-in ones."""


@dataclass(frozen=True, slots=True)
class Skipped:
    """A node that is left out on purpose."""

    package: str
    reason: str


def find_program(node: NodePlan, packages: Packages) -> Program | Skipped:
    """Find the command for a node: its package's program, else a built-in one.

    Raises:
        LaunchError: There is none; it names the place in the launch file.
    """
    try:
        found = program_of(node.package, node.type, packages)
        if found == Program((*_BUILTIN, "nodelet", "nodelet"), None):
            _check_nodelet(_split(node.arguments, node))
    except Error as error:
        raise LaunchError(error.message, source=node.place, hint=error.hint) from None
    return found


def _check_nodelet(words: Sequence[str]) -> None:
    """Check that a nodelet is built in.

    Raises:
        RosError: It is not.
    """
    if len(words) > 1 and words[0] in {"load", "standalone"}:
        registry.nodelet(words[1])


def program_of(package: str, kind: str, packages: Packages) -> Program | Skipped:
    """Find the command for ``rosrun PACKAGE KIND``.

    Raises:
        LaunchError: There is no such package, or it has no such program.
    """
    known = registry.package(package)
    built_in = known is not None and kind in known.nodes
    theirs = known is None or kind not in known.preferred
    if theirs and not (built_in and packages.installed(package) is None):
        path = packages.program(package, kind)
        if path is not None:
            return Program(script_command(path), path.parent)
    if built_in:
        return Program((*_BUILTIN, package, kind), None)
    if known is not None and known.skipped is not None:
        return Skipped(package, known.skipped)
    raise packages.missing_program(package, kind)


def window_command(package: str, kind: str) -> tuple[str, ...] | None:
    """Return the command of a built-in program with a window, or None."""
    known = registry.package(package)
    if known is None or kind not in known.windows:
        return None
    return (*_BUILTIN, package, kind)


def script_command(path: Path) -> tuple[str, ...]:
    """Return the command that runs a file: by ``gazelle exec`` for Python, else directly."""
    return (*_EXECUTE, str(path)) if is_python(path) else (str(path),)


def node_arguments(node: NodePlan, log_file: Path | None = None) -> list[str]:
    """Return the arguments of a node: its own, its remappings, its name.

    Raises:
        LaunchError: Its ``args`` or ``launch-prefix`` are not well quoted.
    """
    arguments = _split(node.arguments, node)
    arguments += [f"{old}:={new}" for old, new in node.remappings]
    arguments.append(f"__name:={node.name}")
    if log_file is not None:
        arguments.append(f"__log:={log_file}")
    return arguments


def prefix_arguments(node: NodePlan) -> list[str]:
    """Return the words of ``launch-prefix``.

    Raises:
        LaunchError: It is not well quoted.
    """
    return _split(node.launch_prefix, node)


def prefixed_command(node: NodePlan, program: Program) -> list[str]:
    """Return a program's command line behind the words of ``launch-prefix``.

    ``python3`` before a Python script names what runs it anyway. A terminal, as in ``xterm -e``,
    is left out where it cannot open a window.

    Raises:
        LaunchError: The prefix is not well quoted.
    """
    words = prefix_arguments(node)
    if program.command[0] == sys.executable and len(words) == 1 and PYTHON.fullmatch(words[0]):
        words = []
    name = Path(words[0]).name if words else ""
    env = {**os.environ, **dict(node.environment)}
    if name in terminal.TERMINALS and terminal.real_terminal(name, env) is None:
        words = [*_TERMINAL, terminal.IN_PLACE, name, *words[1:]]
    return [*words, *program.command]


def _split(text: str, node: NodePlan) -> list[str]:
    try:
        return shlex.split(text)
    except ValueError as error:
        raise LaunchError(f"'{text}' is not well quoted: {error}", source=node.place) from None


def node_environment(
    node: NodePlan, master_uri: str, environment: Mapping[str, str] | None = None
) -> dict[str, str]:
    """Return the environment of a node's process."""
    env = dict(os.environ if environment is None else environment)
    env["ROS_MASTER_URI"] = master_uri
    env.pop("ROS_NAMESPACE", None)
    namespace = node.namespace.rstrip("/")
    if namespace:
        env["ROS_NAMESPACE"] = namespace
    if node.output == "screen":
        env.setdefault("PYTHONUNBUFFERED", "1")  # lines appear when they are printed
    env.update(node.environment)
    return env


def parameter_value(
    parameter: LaunchParameter, packages: Packages, environment: Mapping[str, str] | None = None
) -> Any:
    """Return the value to set; a `ParameterCommand` is run.

    Raises:
        LaunchError: The command fails, or its output is of another type.
    """
    if not isinstance(parameter.value, ParameterCommand):
        return parameter.value
    try:
        output = _output(parameter.value.text, packages, environment)
        return convert(output, parameter.value.kind)
    except LaunchError as error:
        raise LaunchError(error.message, source=parameter.place, hint=error.hint) from None


def command_line(words: Sequence[str], packages: Packages) -> list[str]:
    """Return the command of a ``<param command>`` in its executable form.

    Raises:
        LaunchError: There is no such program.
    """
    program, *rest = words
    if program == "rosrun" and len(rest) >= 2:
        try:
            found = program_of(rest[0], rest[1], packages)
        except LaunchError:
            if shutil.which(program) is None:
                raise
            return [program, *rest]
        if isinstance(found, Skipped):
            raise LaunchError(f"'{found.package}' is left out: {found.reason}")
        return [*found.command, *rest[2:]]
    if Path(program).name in XACRO:
        return [*_BUILTIN, "xacro", "xacro", *rest]
    path = Path(program)
    if path.is_absolute() and path.is_file() and is_python(path):
        return [*script_command(path), *rest]
    if shutil.which(program) is None:
        raise LaunchError(f"there is no program '{program}'")
    return [program, *rest]


def _output(text: str, packages: Packages, environment: Mapping[str, str] | None) -> str:
    try:
        words = shlex.split(text)
    except ValueError as error:
        raise LaunchError(f"the command '{text}' is not well quoted: {error}") from None
    if not words:
        raise LaunchError("the command is empty")
    env = dict(os.environ if environment is None else environment)
    on_path.offer(env)  # a wrapper such as Jackal's env_run starts xacro by its file
    pipes = {"stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    try:
        with child_process(command_line(words, packages), env=env, **pipes) as process:
            try:
                output, errors = communicate(process, _COMMAND_SECONDS)
            except BaseException:
                process.kill()
                raise
    except LaunchError as error:
        raise LaunchError(f"the command '{text}': {error.message}") from None
    except OSError as error:
        raise LaunchError(f"the command '{text}' cannot be run: {error.strerror}") from None
    except subprocess.TimeoutExpired:
        limit = f"{_COMMAND_SECONDS:.0f} s"
        raise LaunchError(f"the command '{text}' does not end within {limit}") from None
    if process.returncode != 0:
        said = errors.decode(errors="replace").strip().splitlines()
        raise LaunchError(
            f"the command '{text}' ended with code {process.returncode}",
            hint=" ".join(said[-3:]) if said else None,
        )
    sys.stderr.write(errors.decode(errors="replace"))  # warnings, as with roslaunch
    return output.decode("utf-8", errors="replace")
