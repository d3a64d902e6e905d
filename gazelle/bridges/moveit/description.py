"""The robot to plan for, as the parameter server describes it."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from typing import Any

from gazelle.errors import PlanningError, PlanningWarning
from gazelle.formats import load_model_string, load_srdf_string
from gazelle.kinematics import JointBounds, RobotModel
from gazelle_ros.base.real_numbers import real
from gazelle_ros.node import Node

DESCRIPTION = "robot_description"


def robot_of_parameters(node: Node, description: str = DESCRIPTION) -> RobotModel:
    """Return the robot of the parameters.

    They are ``robot_description``, ``..._semantic`` and ``..._planning/joint_limits``.

    Args:
        node: Asks, in its own namespace and those around it.
        description: Name of the first parameter; the others begin with it.

    Raises:
        PlanningError: One of the first two is not there.
        Error: One cannot be read.
    """
    model = load_model_string(description_text(node, description), name=description)
    name = f"{description}_semantic"
    semantics = load_srdf_string(description_text(node, name), name=name)
    plain = RobotModel(model, semantics)
    parameters = find_parameter(node, f"{description}_planning", {})
    entries = parameters.get("joint_limits") if isinstance(parameters, Mapping) else None
    if not isinstance(entries or {}, Mapping):
        raise PlanningError(
            f"the parameter '{description}_planning/joint_limits' must map joints to limits, "
            f"not {entries!r:.60}"
        )
    return RobotModel(model, semantics, _limits(plain, entries or {}))


def margins_of_parameters(
    node: Node, robot: RobotModel
) -> tuple[dict[str, float], dict[str, float]]:
    """Return padding [m] and scale of links, from ``..._planning/default_robot_padding`` etc.

    Raises:
        PlanningError: One is not a number.
    """
    parameters = find_parameter(node, f"{DESCRIPTION}_planning", {})
    parameters = parameters if isinstance(parameters, Mapping) else {}
    made: list[dict[str, float]] = []
    for kind in ("padding", "scale"):
        found: dict[str, float] = {}
        if f"default_robot_{kind}" in parameters:
            value = _number(parameters[f"default_robot_{kind}"], f"default_robot_{kind}")
            found = dict.fromkeys(robot.links, value)
        own = parameters.get(f"default_robot_link_{kind}s")
        for link, value in own.items() if isinstance(own, Mapping) else ():
            found[str(link)] = _number(value, f"default_robot_link_{kind}s/{link}")
        made.append(found)
    for name in ("default_object_padding", "default_attached_padding"):
        if parameters.get(name):
            text = f"{DESCRIPTION}_planning/{name} has no effect, as in MoveIt; paddings are of the robot's links"
            warnings.warn(PlanningWarning(text), stacklevel=2)
    return made[0], made[1]


def _number(value: Any, name: str) -> float:
    number = real(value)
    if number is None:
        raise PlanningError(f"the parameter '{name}' must be a number, not {value!r:.60}")
    return number


def find_parameter(node: Node, name: str, default: Any) -> Any:
    """Return a parameter of the nearest namespace that has it."""
    found = node.search_param(name)
    return default if found is None else node.get_param(found, default)


def description_text(node: Node, name: str) -> str:
    """Return the text of a parameter of the nearest namespace that has it.

    Raises:
        PlanningError: There is none.
    """
    text = find_parameter(node, name, None)
    if not isinstance(text, str) or not text.strip():
        raise PlanningError(
            f"there is no parameter '{name}'",
            hint="a package ROBOT_moveit_config sets it in its launch/planning_context.launch",
        )
    return text


def _limits(robot: RobotModel, entries: Mapping[str, Any]) -> dict[str, JointBounds]:
    """Return limits changed by a ``joint_limits.yaml``; joints of other robots are skipped."""
    known = {variable.name: variable.bounds for variable in robot.variables}
    return {
        joint: known[joint].with_parameters(given, joint)
        for joint, given in entries.items()
        if joint in known and isinstance(given, Mapping)
    }
