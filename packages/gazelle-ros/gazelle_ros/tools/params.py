"""Parameters: get, set, load, dump, delete, list."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from gazelle_ros import names
from gazelle_ros.base.errors import did_you_mean
from gazelle_ros.base.text_files import read_text
from gazelle_ros.errors import ApiError, MarshalError
from gazelle_ros.launch.errors import LaunchError
from gazelle_ros.launch.params import flatten
from gazelle_ros.launch.values import load_yaml, load_yaml_documents
from gazelle_ros.tools.errors import ToolError
from gazelle_ros.tools.graph import GraphInspector

_NAMESPACE_KEY = "_ns"


def list_parameters(graph: GraphInspector, space: str | None = None) -> list[str]:
    """Return names of parameters, sorted; those of a namespace, or all."""
    below = names.as_namespace(graph.resolve(space) if space else "/")
    return sorted(name for name in graph.master.param_names() if name.startswith(below))


def get_parameter(graph: GraphInspector, name: str) -> Any:
    """Return the value of a parameter or namespace.

    Raises:
        ToolError: It is not set.
    """
    key = graph.resolve(name)
    try:
        return graph.master.get_param(key)
    except ApiError:
        hint = did_you_mean(key, graph.master.param_names())
        raise ToolError(f"Parameter [{key}] is not set", hint=hint) from None


def as_yaml(value: Any) -> str:
    """Return a value as ``rosparam get`` writes it."""
    import yaml

    text = str(yaml.dump(_plain(value)))
    return text.removesuffix("\n...\n") + "\n"


def _plain(value: Any) -> Any:
    """Convert binary data of XML-RPC to bytes, which YAML knows."""
    if isinstance(value, dict):
        return {key: _plain(inner) for key, inner in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(each) for each in value]
    return value.data if hasattr(value, "data") and isinstance(value.data, bytes) else value


def pretty(value: Any, indent: str = "") -> str:
    """Return a value for display; no YAML where strings look like something else."""
    if not isinstance(value, dict):
        return str(value) + "\n" if isinstance(value, str) else as_yaml(value)
    lines = []
    for key in sorted(value):
        inner = value[key]
        if isinstance(inner, dict):
            lines.append(f"{indent}{key}:\n{pretty(inner, indent + '  ')}")
        elif isinstance(inner, str) and "\n" in inner:
            body = "".join(f"{indent}  {line}\n" for line in inner.split("\n"))
            lines.append(f"{indent}{key}: |\n{body}")
        elif isinstance(inner, str):
            lines.append(f"{indent}{key}: {inner}\n")
        else:
            lines.append(f"{indent}{key}: {as_yaml(inner).rstrip()}\n")
    return "".join(lines)


def set_parameter(graph: GraphInspector, name: str, value: Any) -> list[tuple[str, Any]]:
    """Set a parameter; a mapping is merged into existing parameters, one after another.

    Returns:
        What was set.

    Raises:
        ToolError: The master cannot take the value.
    """
    key = graph.resolve(name)
    if key == "/" and not isinstance(value, dict):
        raise ToolError("global / can only be set to a dictionary")
    done = []
    for each, inner in flatten(key, value):
        try:
            graph.master.set_param(each, inner)
        except (MarshalError, ApiError) as error:
            raise ToolError(f"the parameter {each} cannot be set: {error}") from None
        done.append((each, inner))
    return done


def set_from_text(graph: GraphInspector, name: str, text: str) -> list[tuple[str, Any]]:
    """Set a parameter to a YAML value; returns the value.

    Raises:
        ToolError: It is not YAML, or the master cannot take the value.
    """
    try:
        return set_parameter(graph, name, load_yaml(text or "''"))
    except LaunchError as error:
        raise ToolError(error.message) from None


def load_parameters(
    graph: GraphInspector, file: str, space: str | None = None
) -> list[tuple[str, Any]]:
    """Set the parameters of a YAML file, ``-`` for standard input; returns the set values.

    A document's key ``_ns`` names the namespace it goes to.

    Raises:
        ToolError: The file cannot be read, or is not YAML.
    """
    try:
        text = sys.stdin.read() if file in {"", "-"} else read_text(Path(file))
    except OSError as error:
        raise ToolError(f"the file {file} cannot be read: {error.strerror}") from None
    try:
        documents = load_yaml_documents(text)
    except LaunchError as error:
        raise ToolError(f"{file}: {error.message}") from None
    base = graph.resolve(space) if space else names.namespace_of(graph.caller)
    done = []
    for document in documents:
        if document is None:
            continue
        target = base
        if isinstance(document, dict) and _NAMESPACE_KEY in document:
            target = names.join(base, str(document.pop(_NAMESPACE_KEY)))
        done += set_parameter(graph, names.canonical(target), document)
    return done


def dump_parameters(graph: GraphInspector, space: str | None = None) -> str:
    """Return a namespace, or all parameters, as YAML.

    Raises:
        ToolError: It is not set.
    """
    return as_document(get_parameter(graph, space or names.namespace_of(graph.caller)))


def as_document(value: Any) -> str:
    """Return a value as the YAML document that rosparam writes."""
    import yaml

    return str(yaml.dump(_plain(value)))


def leaves(value: Any, name: str) -> Iterator[tuple[str, Any]]:
    """Yield all parameters of a namespace that are no namespaces themselves, with their names."""
    if not isinstance(value, dict):
        yield name, value
        return
    for key, inner in value.items():
        yield from leaves(inner, names.join(name, key))


def delete_parameter(graph: GraphInspector, name: str) -> None:
    """Delete a parameter or namespace; ``/`` deletes all.

    Raises:
        ToolError: It is not set.
    """
    key = graph.resolve(name)
    if key == "/":
        graph.master.set_param("/", {})
        return
    try:
        graph.master.delete_param(key)
    except ApiError:
        hint = did_you_mean(key, graph.master.param_names())
        raise ToolError(f"parameter [{key}] is not set", hint=hint) from None
