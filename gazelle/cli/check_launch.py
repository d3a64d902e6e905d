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

_BUILT_IN = "built in"


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
        A line for each program and each planner of ``move_base``, and the problems: an error for
        each node without one, a warning for each that is left out on purpose, and those of the
        parameters of ``move_base``, the worlds and the robots.
    """
    from gazelle.cli.launched_files import LaunchedFiles
    from gazelle.cli.launched_plugins import check_move_base
    from gazelle_ros.launch import Packages, load_launch

    packages = Packages()
    try:
        plan = load_launch(file, arguments, packages=packages)
    except Error as error:
        return [], [Problem.of(error)]
    rows: list[tuple[str, str]] = []
    problems = [Problem("warning", notice) for notice in plan.notices]
    for node in (*plan.nodes, *plan.tests):
        state, problem = _look_for(node, packages)
        rows.append((_label(node), state))
        if problem is not None:
            problems.append(problem)
        if state == _BUILT_IN and (node.package, node.type) == ("move_base", "move_base"):
            plugins, found = check_move_base(node, plan)
            rows += [(f"{_label(node)} {kind}", where) for kind, where in plugins]
            problems += found
    problems += LaunchedFiles(plan, engine).check()
    width = max((len(label) for label, _ in rows), default=0)
    return list(dict.fromkeys(f"  {label:<{width}}  {state}" for label, state in rows)), problems


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
    return _BUILT_IN if program.folder is None else str(program.folder), None
