"""Check of the plugins and parameters of ``move_base`` in a launch file."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping
from typing import Any

from gazelle.errors import Error
from gazelle.formats import Problem
from gazelle.navigation.move_base import navigation_stack
from gazelle.navigation.move_base.settings import MoveBaseSettings
from gazelle.navigation.planners.plugins import global_planner, local_planner, names_class
from gazelle_ros.launch.plan import LaunchParameter, LaunchPlan, NodePlan, ParameterCommand

_FINDERS: Mapping[str, Callable[[str], object]] = {
    "base_global_planner": global_planner,
    "base_local_planner": local_planner,
}
PluginRow = tuple[str, str]
"""A plugin, and where it is."""


def check_move_base(node: NodePlan, plan: LaunchPlan) -> tuple[list[PluginRow], list[Problem]]:
    """Return the planners of a built-in ``move_base``, and what is wrong with its parameters.

    Planners of one's own, ``module:Class``, are not imported: a check executes nothing that a file
    names.

    Args:
        node: The node.
        plan: Content of the launch file; parameters that others set are not known.
    """
    below = f"{node.full_name}/"
    known = {
        name.removeprefix(below): each
        for name, each in plan.parameters.items()
        if name.startswith(below) and not isinstance(each.value, ParameterCommand)
    }
    rows: list[PluginRow] = []
    problems: list[Problem] = []
    for name, find in _FINDERS.items():
        row, problem = _look_for(name, find, known.get(name))
        rows.append(row)
        problems += [] if problem is None else [problem]
    if not problems and not any(state == "your own" for _, state in rows):
        problems = _try_parameters(node, _nested(known))
    return rows, problems


def _try_parameters(node: NodePlan, values: Mapping[str, Any]) -> list[Problem]:
    """Return what is wrong with parameters, at the place of the node."""
    place = node.place.file, node.place.line
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            navigation_stack(values)
        except Error as error:
            message = f"{node.full_name}: {error.message}"
            return [Problem("error", message, *place, hint=error.hint)]
    return [Problem("warning", f"{node.full_name}: {each.message}", *place) for each in caught]


def _look_for(
    name: str, find: Callable[[str], object], given: LaunchParameter | None
) -> tuple[PluginRow, Problem | None]:
    """Return a planner and where it is, and what is wrong with its type."""
    kind = getattr(MoveBaseSettings(), name) if given is None else given.value
    if not isinstance(kind, str) or names_class(kind):
        return (str(kind), "your own"), None
    try:
        find(kind)
    except Error as error:
        place = None if given is None else given.place
        file, line = (None, None) if place is None else (place.file, place.line)
        return (kind, "missing"), Problem("error", error.message, file, line, hint=error.hint)
    return (kind, "built in"), None


def _nested(parameters: Mapping[str, LaunchParameter]) -> dict[str, Any]:
    """Return parameters by name as mappings in each other."""
    found: dict[str, Any] = {}
    for name, each in parameters.items():
        *spaces, last = name.split("/")
        space = found
        for part in spaces:
            inner = space.setdefault(part, {})
            space = inner if isinstance(inner, dict) else {}
        space[last] = each.value
    return found
