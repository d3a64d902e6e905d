"""``<param>`` and ``<rosparam>``."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, cast

from gazelle_ros import names
from gazelle_ros.base.bundled_packages import published, published_hint
from gazelle_ros.base.errors import did_you_mean
from gazelle_ros.launch.document import Element
from gazelle_ros.launch.errors import LaunchError
from gazelle_ros.launch.limits import read_bounded
from gazelle_ros.launch.plan import (
    Action,
    LaunchParameter,
    LaunchPlan,
    ParameterCommand,
    SourceLocation,
)
from gazelle_ros.launch.scope import LaunchScope
from gazelle_ros.launch.values import KINDS, convert, load_yaml

_SOURCES = ("value", "textfile", "binfile", "command")
_COMMANDS = ("load", "dump", "delete")


def place_of(element: Element) -> SourceLocation:
    """Return the source location of an element."""
    return SourceLocation(element.file, element.line, element.label)


def put(plan: LaunchPlan, parameter: LaunchParameter) -> None:
    """Add a parameter to a plan; the last one of a name wins."""
    plan.parameters[parameter.name] = parameter


def put_at(plan: LaunchPlan, name: str, parameter: LaunchParameter) -> None:
    """Add a parameter under another name."""
    put(plan, replace(parameter, name=names.canonical(name)))


def read_param(element: Element, scope: LaunchScope) -> LaunchParameter:
    """Read the parameter of a ``<param>``, its name as written.

    Raises:
        LaunchError: It has not exactly one source of its value, or a value of the wrong type.
    """
    (name,) = scope.required(element, "name")
    name = name.strip()
    if not name:
        raise element.error("the name is empty")
    given = [key for key in _SOURCES if key in element.attributes]
    if len(given) != 1:
        raise element.error("a param has exactly one of " + ", ".join(_SOURCES))
    kind = (element.attributes.get("type") or "auto").strip().lower()
    if kind not in KINDS:
        raise element.error(f"type='{kind}' is unknown", did_you_mean(kind, KINDS))
    text = cast("str", scope.text(element, given[0]))
    try:
        file = str(published(text)) if given[0] == "textfile" else None
        return LaunchParameter(name, _value(given[0], text, kind), place_of(element), file)
    except LaunchError as error:
        raise element.error(error.message, error.hint) from None
    except OSError as error:
        message = f"{given[0]}='{text}' cannot be read: {error.strerror}"
        raise element.error(message, published_hint(text)) from None


def _value(source: str, text: str, kind: str) -> Any:
    if source == "value":
        return convert(text.strip(), kind)
    if source == "textfile":
        return convert(read_bounded(published(text)).decode("utf-8", "replace"), kind)
    if source == "binfile":
        return read_bounded(published(text))
    return ParameterCommand(text, kind)


def read_rosparam(element: Element, scope: LaunchScope, plan: LaunchPlan) -> None:
    """Add a ``<rosparam>`` to the plan, relative to the scope's namespace.

    Raises:
        LaunchError: The command is unknown, the file cannot be read, or the text is not YAML.
    """
    command = scope.text(element, "command") or "load"
    if command not in _COMMANDS:
        raise element.error(f"command='{command}' is unknown", did_you_mean(command, _COMMANDS))
    file = scope.text(element, "file")
    param = names.join(scope.text(element, "ns") or "", scope.text(element, "param") or "")
    name = names.canonical(names.join(scope.namespace, param) if param else scope.namespace)
    if command == "load":
        _load(element, scope, plan, name, file, has_name=bool(param))
    elif command == "dump":
        if not file:
            raise element.error("dump needs the attribute 'file'")
        plan.actions.append(Action("dump", name, file, place_of(element)))
    elif file is not None:
        raise element.error("delete takes no 'file'")
    else:
        plan.actions.append(Action("delete", name, None, place_of(element)))


def _load(
    element: Element,
    scope: LaunchScope,
    plan: LaunchPlan,
    name: str,
    file: str | None,
    *,
    has_name: bool,
) -> None:
    text = element.text
    if file:
        try:
            text = read_bounded(published(file)).decode("utf-8", "replace")
        except LaunchError as error:
            raise element.error(error.message) from None
        except OSError as error:
            message = f"the file '{file}' cannot be read: {error.strerror}"
            raise element.error(message, published_hint(file)) from None
    if scope.flag(element, "subst_value"):
        text = scope.resolve(text, element)
    try:
        data = load_yaml(text, file) if file else load_yaml(text, element.file, element.line)
    except LaunchError as error:
        where = f"{file}: " if file else ""
        raise element.error(where + error.message, error.hint) from None
    data = {} if data is None else data
    if not has_name and not isinstance(data, dict):
        raise element.error("a value that is not a mapping needs the attribute 'param'")
    if names.is_private(name):
        for key, value in flatten(name[1:], data):
            scope.private.append((key, value, place_of(element)))
        return
    for key, value in flatten(name, data):
        put(plan, LaunchParameter(key, value, place_of(element)))


def flatten(name: str, value: Any) -> list[tuple[str, Any]]:
    """Return a mapping as single parameters with their names; another value as it is."""
    if not isinstance(value, dict):
        return [(names.canonical(name), value)]
    found = []
    for key, inner in value.items():
        found += flatten(names.join(name, str(key)) if name else str(key), inner)
    return found
