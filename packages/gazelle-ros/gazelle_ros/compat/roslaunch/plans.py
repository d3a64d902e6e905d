"""Between the nodes of scripts and those of Gazelle's launch plans."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, cast

from gazelle_ros.compat.roslaunch.core import Node, RLException, Test
from gazelle_ros.launch.loader import load_launch, load_launch_text
from gazelle_ros.launch.plan import LaunchPlan, NodePlan, SourceLocation, TestPlan
from gazelle_ros.names import split_arguments

Files = list[Any]
"""Paths, or pairs of a path and its arguments."""


def load_plan(files: Files, texts: list[str] | None = None) -> LaunchPlan:
    """Load the plan of launch files and of texts.

    Raises:
        LaunchError: One is malformed.
        RLException: Arguments are neither a list nor a string.
    """
    whole = LaunchPlan()
    for each in files:
        path, given = (each, []) if isinstance(each, str) else each
        words = given.split() if isinstance(given, str) else list(given)
        _merge(whole, load_launch(path, split_arguments(words)[1]))
    for text in texts or ():
        _merge(whole, load_launch_text(text))
    return whole


def _merge(whole: LaunchPlan, part: LaunchPlan) -> None:
    taken = {node.full_name for node in [*whole.nodes, *whole.tests]}
    for node in [*part.nodes, *part.tests]:
        if node.full_name in taken:
            raise RLException(f"roslaunch file contains multiple nodes named [{node.full_name}].")
    for name in ("files", "clear", "actions", "nodes", "tests", "notices"):
        getattr(whole, name).extend(getattr(part, name))
    for name in ("arguments", "parameters", "machines"):
        getattr(whole, name).update(getattr(part, name))


def plan_of(node: Node) -> NodePlan:
    """Return the plan of a script's node."""
    return NodePlan(
        package=node.package,
        type=node.type,
        name=node.name or node.type.partition(".")[0],
        namespace=node.namespace,
        place=SourceLocation(node.filename, 0, f"node[@pkg='{node.package}']"),
        arguments=node.args,
        respawn=bool(node.respawn),
        respawn_delay=float(node.respawn_delay),
        required=bool(node.required),
        output=cast("Any", node.output or "log"),
        cwd=cast("Any", node.cwd),
        launch_prefix=node.launch_prefix or "",
        environment=tuple(node.env_args),
        remappings=tuple(node.remap_args),
    )


def node_of(plan: NodePlan) -> Node:
    """Return a script's node, or test, of a plan."""
    common: dict[str, Any] = {
        "name": plan.name,
        "namespace": plan.namespace,
        "machine_name": plan.machine,
        "args": plan.arguments,
        "remap_args": plan.remappings,
        "env_args": plan.environment,
        "cwd": None if plan.cwd == "ros-root" else plan.cwd,
        "launch_prefix": plan.launch_prefix,
        "filename": plan.place.file,
    }
    if isinstance(plan, TestPlan):
        return Test(
            plan.test_name,
            plan.package,
            plan.type,
            time_limit=plan.time_limit,
            retry=plan.retry,
            **common,
        )
    return Node(
        plan.package,
        plan.type,
        respawn=plan.respawn,
        respawn_delay=plan.respawn_delay,
        required=plan.required,
        output=plan.output,
        **common,
    )


def required(plan: LaunchPlan) -> None:
    """Make all nodes of a plan required."""
    plan.nodes = [replace(each, required=True, respawn=False) for each in plan.nodes]
