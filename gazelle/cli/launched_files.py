"""Check of the worlds and robots that the nodes of a launch file load."""

from __future__ import annotations

import argparse
import contextlib
import io
import os
import shlex
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path

from gazelle.bridges.gazebo import server as gzserver
from gazelle.cli.file_checks import check_file, check_text
from gazelle.clients import spawn_model
from gazelle.errors import Error
from gazelle.formats import Problem
from gazelle.stage.bridge import server as stageros
from gazelle_ros import names
from gazelle_ros.base.bundled_packages import published
from gazelle_ros.builtin.arguments import parse_arguments
from gazelle_ros.launch.plan import (
    LaunchParameter,
    LaunchPlan,
    NodePlan,
    ParameterCommand,
    SourceLocation,
)
from gazelle_ros.launch.programs import XACRO, node_arguments

_SERVERS = {"gzserver", "gazebo", "debug", "perf"}
_DESCRIPTION = "/robot_description"
_READERS = {*XACRO, "cat"}

_Parse = Callable[[Sequence[str]], argparse.Namespace]


class LaunchedFiles:
    """The worlds and robots of one launch; each is checked once.

    Args:
        plan: Content of the launch file.
        engine: Builds worlds and spawned models; None reads them only.
    """

    def __init__(self, plan: LaunchPlan, engine: str | None) -> None:
        self._plan, self._engine = plan, engine
        self._checked: set[tuple[str, str]] = set()

    def check(self) -> list[Problem]:
        """Return the problems of worlds, spawned models, and descriptions that are only shown."""
        found: list[Problem] = []
        for node in self._plan.nodes:
            with _environment(dict(node.environment)):
                found += _placed(partial(self._check_node, node), node.place)
        for each in self._plan.parameters.values():
            if each.name.endswith(_DESCRIPTION):
                found += _placed(partial(self._check_parameter, each, None), each.place)
        return found

    def _check_node(self, node: NodePlan) -> list[Problem]:
        if node.package == "stage_ros" and node.type == "stageros":
            world = _options(stageros.parse_options, node).world
            return self._check_file(world, "planar" if self._engine else None)
        if node.package != "gazebo_ros":
            return []
        if node.type in _SERVERS:
            world = gzserver.find_world(_options(gzserver.parse_options, node).world)
            return self._check_file(world, self._engine)
        if node.type == "spawn_model":
            return self._check_spawned(_options(spawn_model.parse_options, node), node)
        return []

    def _check_spawned(self, options: argparse.Namespace, node: NodePlan) -> list[Problem]:
        if options.file:
            return self._check_file(str(published(options.file)), self._engine)
        if options.database:
            return self._check_file(f"model://{options.database}", self._engine)
        if not options.param:
            return []
        name = names.resolve(options.param, node.full_name)
        parameter = self._plan.parameters.get(name)
        # A node or another launch file may set it.
        return [] if parameter is None else self._check_parameter(parameter, self._engine)

    def _check_parameter(self, parameter: LaunchParameter, engine: str | None) -> list[Problem]:
        if parameter.file is not None:
            return self._check_file(parameter.file, engine)
        expanded = _source_of(parameter)
        if expanded is not None:
            return self._check_file(expanded[0], engine, expanded[1])
        text, name = parameter.value, f"parameter '{parameter.name}'"
        # Other commands are run by a launch only: a check executes nothing that a file names.
        if not isinstance(text, str) or not self._is_new(name, ""):
            return []
        return check_text(text, name, engine)

    def _check_file(
        self, file: str, engine: str | None, xacro_args: Mapping[str, str] | None = None
    ) -> list[Problem]:
        if not self._is_new(file, str(xacro_args or {})):
            return []
        return check_file(file, engine, xacro_args=xacro_args)

    def _is_new(self, name: str, arguments: str) -> bool:
        """Return whether something has not been checked yet."""
        before = len(self._checked)
        self._checked.add((name, arguments))
        return len(self._checked) > before


def _source_of(parameter: LaunchParameter) -> tuple[str, dict[str, str]] | None:
    """Return the file and arguments of a command ``xacro`` or ``cat``; findings name its lines."""
    if not isinstance(parameter.value, ParameterCommand):
        return None
    try:
        words = shlex.split(parameter.value.text)
    except ValueError:  # an error of the launch, too
        return None
    if words[:2] == ["rosrun", "xacro"]:
        words = words[2:]
    if not words or Path(words[0]).name not in _READERS:
        return None
    plain, arguments = names.split_arguments(words[1:])
    files = [each for each in plain if not each.startswith("-")]
    return (str(published(files[0])), arguments) if len(files) == 1 else None


def _options(parse: _Parse, node: NodePlan) -> argparse.Namespace:
    """Return the options of a node's command line.

    Raises:
        Error: They cannot be parsed.
    """
    words = parse_arguments(node_arguments(node), node.name).plain
    errors = io.StringIO()
    try:
        with contextlib.redirect_stderr(errors):
            return parse(words)
    except SystemExit:
        last = errors.getvalue().strip().rpartition("\n")[2]
        raise Error(f"the arguments of {node.full_name} are wrong: {last}") from None


def _placed(check: Callable[[], list[Problem]], place: SourceLocation) -> list[Problem]:
    """Return the findings of a check, each with a place in a file."""
    try:
        found = check()
    except Error as error:
        found = [Problem.of(error, place.file)]
    return [_at(each, place) for each in found]


def _at(problem: Problem, place: SourceLocation) -> Problem:
    """Return a finding; that a file is missing is a mistake of the launch file."""
    if problem.line is not None:
        return problem
    if problem.file == place.file:
        return replace(problem, line=place.line)
    if problem.file is None or Path(problem.file).exists():
        return problem
    message = f"{problem.message}: '{problem.file}'"
    return replace(problem, message=message, file=place.file, line=place.line)


@contextlib.contextmanager
def _environment(values: Mapping[str, str]) -> Iterator[None]:
    """Set environment variables while it lasts."""
    former = dict(os.environ)
    os.environ.update(values)
    try:
        yield
    finally:
        os.environ.clear()
        os.environ.update(former)
