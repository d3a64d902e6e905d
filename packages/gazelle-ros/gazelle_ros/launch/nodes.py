"""``<node>`` and ``<test>``."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, cast

from gazelle_ros import names
from gazelle_ros.base.errors import did_you_mean
from gazelle_ros.launch import params
from gazelle_ros.launch.document import Element
from gazelle_ros.launch.plan import LaunchParameter, LaunchPlan, NodePlan, TestPlan
from gazelle_ros.launch.scope import LaunchScope

NODE_ATTRIBUTES = (
    "pkg", "type", "name", "args", "machine", "respawn", "respawn_delay", "required", "ns",
    "clear_params", "output", "cwd", "launch-prefix",
)  # fmt: skip
TEST_ATTRIBUTES = (*NODE_ATTRIBUTES, "test-name", "time-limit", "retry")
_NOT_FOR_TESTS = ("respawn", "respawn_delay", "output")
_OUTPUTS = ("log", "screen")
_FOLDERS = ("ROS_HOME", "ros-root", "node")


def read_node(
    element: Element,
    children: Iterable[Element],
    scope: LaunchScope,
    inner: LaunchScope,
    plan: LaunchPlan,
    *,
    machine: str,
) -> tuple[NodePlan, list[LaunchParameter]]:
    """Read a ``<node>`` or ``<test>``, and its private parameters.

    Args:
        element: The element.
        children: Child elements.
        scope: The scope around it.
        inner: The scope with the node's namespace.
        plan: Gets what ``<rosparam>`` in it loads.
        machine: The default machine.

    Raises:
        LaunchError: An attribute is missing or wrong.
    """
    is_test = element.tag == "test"
    common = _common(element, scope, is_test=is_test)
    own = inner.child(common["name"])
    own.private = []
    outer = scope.child()
    for child in children:
        if outer.applies(child):
            _child(child, outer, own, plan)
    space = inner.namespace + common["name"] + "/"
    parameters = [
        LaunchParameter(names.canonical(space + key), value, place)
        for key, value, place in [*scope.private, *own.private]
    ]
    common |= {
        "namespace": inner.namespace,
        "machine": scope.text(element, "machine") or machine,
        "environment": tuple(outer.environment),
        "remappings": tuple(outer.remappings.items()),
        "place": params.place_of(element),
    }
    if is_test:
        return TestPlan(**common, **_test(element, scope)), parameters
    return NodePlan(**common, **_behaviour(element, scope)), parameters


def _child(child: Element, outer: LaunchScope, own: LaunchScope, plan: LaunchPlan) -> None:
    """Add one element of a node."""
    tag = child.tag.lower()
    if tag == "remap":
        old, new = outer.required(child, "from", "to")
        outer.remap(child, old, new)
    elif tag == "env":
        outer.environment.append(cast("tuple[str, str]", outer.required(child, "name", "value")))
    elif tag == "param":
        parameter = params.read_param(child, own)
        key = parameter.name.removeprefix("~")
        own.private[:] = [each for each in own.private if each[0] != key]
        own.private.append((key, parameter.value, parameter.place))
    else:
        params.read_rosparam(child, own, plan)


def _common(element: Element, scope: LaunchScope, *, is_test: bool) -> dict[str, Any]:
    """Return the settings that nodes and tests share."""
    package, kind = scope.required(element, "pkg", "type")
    if is_test:
        name = scope.text(element, "name") or scope.required(element, "test-name")[0]
    else:
        (name,) = scope.required(element, "name")
    for label, value in (("pkg", package), ("type", kind), ("name", name)):
        if not value.strip():
            raise element.error(f"the attribute '{label}' is empty")
    if "/" in name:
        raise element.error(
            f"a node's name cannot have a namespace: '{name}'", "use the attribute 'ns'"
        )
    folder = scope.text(element, "cwd")
    if folder is not None and folder not in _FOLDERS:
        raise element.error(f"cwd='{folder}' is unknown", did_you_mean(folder, _FOLDERS))
    return {
        "package": package,
        "type": kind,
        "name": name,
        "arguments": scope.text(element, "args") or "",
        "cwd": folder,
        "launch_prefix": scope.text(element, "launch-prefix") or "",
    }


def _behaviour(element: Element, scope: LaunchScope) -> dict[str, Any]:
    """Return the settings that only nodes have."""
    output = scope.text(element, "output") or "log"
    if output not in _OUTPUTS:
        raise element.error(f"output='{output}' is unknown", did_you_mean(output, _OUTPUTS))
    respawn, required = scope.flag(element, "respawn"), scope.flag(element, "required")
    if respawn and required:
        raise element.error("a node is respawned or required, not both")
    delay = scope.number(element, "respawn_delay", 0.0)
    return {
        "output": output,
        "respawn": respawn,
        "required": required,
        "respawn_delay": delay,
    }


def _test(element: Element, scope: LaunchScope) -> dict[str, Any]:
    """Return the settings that only tests have."""
    for key in _NOT_FOR_TESTS:
        if key in element.attributes:
            raise element.error(f"a test has no '{key}'")
    (name,) = scope.required(element, "test-name")
    limit = scope.number(element, "time-limit", 60.0)
    if not limit > 0.0:
        raise element.error("time-limit must be above 0")
    retry = scope.number(element, "retry", 0.0)
    if retry != int(retry) or retry < 0:
        raise element.error("retry must be an int")
    return {"test_name": name, "time_limit": limit, "retry": int(retry)}
