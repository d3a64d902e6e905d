"""Plans as text for people."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from gazelle_ros import names
from gazelle_ros.base.errors import did_you_mean
from gazelle_ros.launch.errors import LaunchError
from gazelle_ros.launch.packages import Packages
from gazelle_ros.launch.plan import Argument, LaunchPlan, NodePlan, ParameterCommand
from gazelle_ros.launch.programs import (
    Skipped,
    find_program,
    node_arguments,
    node_environment,
    parameter_value,
    prefixed_command,
)

_LONGEST = 20


def summary(plan: LaunchPlan) -> str:
    """Return parameters and nodes, as roslaunch shows them before it starts."""
    lines = ["SUMMARY", "========", "", "PARAMETERS"]
    lines += [
        f" * {name}: {_short(parameter.value)}"
        for name, parameter in sorted(plan.parameters.items())
    ]
    lines += ["", "NODES"]
    spaces = sorted({node.namespace for node in plan.nodes})
    for space in spaces:
        lines.append(f"  {space}")
        lines += [
            f"    {node.name} ({node.package}/{node.type})"
            for node in sorted(plan.nodes, key=lambda node: node.name)
            if node.namespace == space
        ]
    return "\n".join(lines) + "\n"


def outline(plan: LaunchPlan) -> str:
    """Return in one line which files are launched, and the numbers of nodes and parameters."""
    files = ", ".join(Path(file).name for file in plan.files[:1]) or "roscore"
    counts = ", ".join(
        f"{number} {noun}{'' if number == 1 else 's'}"
        for number, noun in ((len(plan.nodes), "node"), (len(plan.parameters), "parameter"))
    )
    return f"{files}: {counts}"


def _short(value: Any) -> str:
    if isinstance(value, ParameterCommand):
        return f"<output of: {value.text}>"
    if isinstance(value, bytes):
        return f"<{len(value)} bytes>"
    text = " ".join(str(value).split())
    return text if len(text) <= _LONGEST else text[:_LONGEST] + "..."


def arguments(plan: LaunchPlan) -> str:
    """Return the arguments that the files take, required ones first."""
    groups: dict[str, list[Argument]] = {"Required Arguments:": [], "Optional Arguments:": []}
    for each in plan.arguments.values():
        if not each.constant:
            optional = each.default is not None
            groups["Optional Arguments:" if optional else "Required Arguments:"].append(each)
    lines = []
    for title, members in groups.items():
        if members:
            lines.append(title)
        for each in sorted(members, key=lambda each: each.name):
            default = f' (default "{each.default}")' if each.default is not None else ""
            doc = each.doc or "undocumented"
            lines.append(f"  {each.name}{default}: {doc}")
    return "\n".join(lines) + "\n" if lines else "No arguments.\n"


def parameters(plan: LaunchPlan, packages: Packages) -> str:
    """Return all parameters as YAML; commands are run.

    Raises:
        LaunchError: A command fails.
    """
    import yaml

    values = {name: parameter_value(each, packages) for name, each in plan.parameters.items()}
    return str(yaml.safe_dump(values, allow_unicode=True))


def find_node(plan: LaunchPlan, name: str) -> NodePlan:
    """Return the node of a name.

    Raises:
        LaunchError: There is none; the hint names the closest.
    """
    full_name = names.canonical(names.join("/", name))
    known = {node.full_name: node for node in [*plan.nodes, *plan.tests]}
    if full_name not in known:
        raise LaunchError(f"there is no node '{full_name}'", hint=did_you_mean(full_name, known))
    return known[full_name]


def command(node: NodePlan, packages: Packages, master_uri: str) -> list[str]:
    """Return the command line of a node, with its environment before it.

    Raises:
        LaunchError: It has no program.
    """
    program = find_program(node, packages)
    if isinstance(program, Skipped):
        raise LaunchError(f"nodes of '{program.package}' are left out: {program.reason}")
    env = node_environment(node, master_uri, {})
    return [
        *(f'{key}="{value}"' for key, value in env.items()),
        *prefixed_command(node, program),
        *node_arguments(node),
    ]
