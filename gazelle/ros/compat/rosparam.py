"""rosparam's interface: parameters as YAML."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from gazelle.ros import names
from gazelle.ros.compat import commands
from gazelle.ros.compat.rospy.msproxy import MasterProxy
from gazelle.ros.compat.tool_errors import raising
from gazelle.ros.launch.errors import LaunchError
from gazelle.ros.launch.values import load_yaml, load_yaml_documents
from gazelle.ros.tools import params
from gazelle.ros.tools.graph import GraphInspector

NS = "_ns"


class RosParamException(Exception):  # noqa: N818  # rosparam's names
    """Root of the errors about parameters."""


class RosParamIOException(RosParamException):
    """The master does not answer."""


def _graph() -> GraphInspector:
    return GraphInspector("rosparam")


def get_param_server() -> MasterProxy:
    """The master."""
    return MasterProxy(_graph().master_uri)


@raising(RosParamIOException, RosParamException)
def get_param(param: str) -> Any:
    """The value of a parameter.

    Raises:
        RosParamException: It is not set.
    """
    return params.get_parameter(_graph(), param)


@raising(RosParamIOException, RosParamIOException)
def list_params(ns: str = "") -> list[str]:
    """Names of the parameters in a namespace."""
    return params.list_parameters(_graph(), ns or None)


@raising(RosParamIOException, RosParamException)
def set_param_raw(param: str, value: Any, verbose: bool = False) -> None:  # noqa: FBT001, FBT002  # rosparam's interface
    """Set a parameter.

    Raises:
        RosParamException: The master cannot take the value.
    """
    params.set_parameter(_graph(), param, value)
    if verbose:
        sys.stdout.write(f"set parameter [{param}] to [{value}]\n")


def set_param(param: str, value: str, verbose: bool = False) -> None:  # noqa: FBT001, FBT002  # rosparam's interface
    """Set a parameter to a YAML text.

    Raises:
        RosParamException: It is not YAML, or the master cannot take the value.
    """
    set_param_raw(param, _yaml(value), verbose)


def _yaml(text: str) -> Any:
    try:
        return load_yaml(text)
    except LaunchError as error:
        raise RosParamException(str(error)) from None


def upload_params(ns: str, values: Any, verbose: bool = False) -> None:  # noqa: FBT001, FBT002  # rosparam's interface
    """Set all parameters of a dict below a namespace, each for itself.

    Raises:
        RosParamException: The master cannot take them.
    """
    if ns == "/" and not isinstance(values, dict):
        raise RosParamException("global / can only be set to a dictionary")
    if not isinstance(values, dict):
        set_param_raw(ns, values, verbose)
        return
    for key, value in values.items():
        upload_params(names.join(ns, str(key)), value, verbose)


@raising(RosParamIOException, RosParamException)
def delete_param(param: str, verbose: bool = False) -> None:  # noqa: FBT001, FBT002  # rosparam's interface
    """Remove a parameter.

    Raises:
        RosParamException: It is not set.
    """
    params.delete_parameter(_graph(), param)
    if verbose:
        sys.stdout.write(f"deleted parameter [{param}]\n")


def load_str(
    str: str,  # noqa: A002  # rosparam's interface
    filename: str,
    default_namespace: str | None = None,
    verbose: bool = False,  # noqa: FBT001, FBT002
) -> list[tuple[Any, str]]:
    """Read parameters from a YAML text; a key ``_ns`` names the namespace of its document.

    Returns:
        Values and namespaces.

    Raises:
        RosParamException: It is not YAML.
    """
    del verbose
    base = default_namespace or names.namespace_of(_graph().caller)
    try:
        documents = load_yaml_documents(str)
    except LaunchError as error:
        raise RosParamException(f"{filename}: {error}") from None
    found = []
    for document in documents:
        space = base
        if isinstance(document, dict) and NS in document:
            space = names.join(base, f"{document.pop(NS)}")
        found.append((document, space))
    return found


def load_file(
    filename: str,
    default_namespace: str | None = None,
    verbose: bool = False,  # noqa: FBT001, FBT002  # rosparam's interface
) -> list[tuple[Any, str]]:
    """Read parameters from a YAML file, ``-`` for standard input; see `load_str`.

    Raises:
        RosParamException: It cannot be read, or is not YAML.
    """
    try:
        text = sys.stdin.read() if filename == "-" else Path(filename).read_text(encoding="utf-8")
    except OSError as error:
        raise RosParamException(f"file [{filename}] does not exist: {error.strerror}") from None
    return load_str(text, filename, default_namespace, verbose)


@raising(RosParamIOException, RosParamException)
def dump_params(filename: str | None, param: str, verbose: bool = False) -> None:  # noqa: FBT001, FBT002  # rosparam's interface
    """Write a namespace as YAML to a file, or to standard output.

    Raises:
        RosParamException: It is not set.
    """
    del verbose
    text = params.dump_parameters(_graph(), param)
    if filename:
        Path(filename).write_text(text, encoding="utf-8")
    else:
        sys.stdout.write(text)


def yamlmain(argv: Sequence[str] | None = None) -> None:
    """Do what the command rosparam does; see `gazelle.ros.compat.commands.run`.

    Args:
        argv: The command line, by default this process's.

    Raises:
        SystemExit: It failed.
    """
    commands.run("param", argv)


def _fullusage() -> None:
    """Say what there is, and end the process."""
    yamlmain(["rosparam", "--help"])
    raise SystemExit(0)
