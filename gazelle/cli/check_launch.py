"""Check of a launch file: the program of each node, and the worlds and robots that they load."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from gazelle.errors import Error
from gazelle.formats import Problem

if TYPE_CHECKING:
    from gazelle_ros.launch.packages import Packages
    from gazelle_ros.launch.plan import NodePlan


def is_launch(file: str) -> bool:
    """Return whether a file is a launch file, by its name."""
    from gazelle_ros.launch.finding import SUFFIXES

    return file.endswith(SUFFIXES) and Path(file).is_file()


def check_launch(
    file: str, arguments: Mapping[str, str], engine: str | None
) -> tuple[list[str], list[Problem]]:
    """Read a launch file, look for the program of each node, and check what the nodes load.

    Args:
        file: Launch file.
        arguments: Values of its ``<arg>`` elements.
        engine: Builds its worlds and robots; None reads them only.

    Returns:
        A line for each program, and the problems: an error for each node without one, a warning
        for each that is left out on purpose, and those of the worlds and robots.
    """
    from gazelle.cli.launched_files import LaunchedFiles
    from gazelle_ros.launch import Packages, load_launch

    packages = Packages()
    try:
        plan = load_launch(file, arguments, packages=packages)
    except Error as error:
        return [], [Problem.of(error)]
    lines: list[str] = []
    problems = [Problem("warning", notice) for notice in plan.notices]
    nodes = [*plan.nodes, *plan.tests]
    width = max((len(_label(each)) for each in nodes), default=0)
    for node in nodes:
        state, problem = _look_for(node, packages)
        lines.append(f"  {_label(node):<{width}}  {state}")
        if problem is not None:
            problems.append(problem)
    problems += LaunchedFiles(plan, engine).check()
    return list(dict.fromkeys(lines)), problems


def _label(node: NodePlan) -> str:
    """Return the program of a node and, of a nodelet, its class."""
    words = node.arguments.split()
    kind = words[1:2] if node.package == "nodelet" and words[:1] != ["unload"] else []
    return " ".join([f"{node.package}/{node.type}", *kind])


def _look_for(node: NodePlan, packages: Packages) -> tuple[str, Problem | None]:
    """Return where a node's program is, and what is wrong with it."""
    from gazelle_ros.launch.programs import Skipped, find_program

    try:
        program = find_program(node, packages)
    except Error as error:
        return "missing", Problem.of(error)
    if isinstance(program, Skipped):
        return "left out", Problem(
            "warning",
            f"{node.full_name} is left out: {program.reason}",
            node.place.file,
            node.place.line,
        )
    return "built in" if program.folder is None else str(program.folder), None
