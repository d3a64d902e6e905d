"""rosparam's interface: parameters as YAML."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from gazelle_ros import names
from gazelle_ros.base.writing import write_text
from gazelle_ros.compat import commands
from gazelle_ros.compat.rosgraph.masterapi import Master
from gazelle_ros.compat.rosgraph.names import get_ros_namespace, make_global_ns
from gazelle_ros.compat.tool_errors import raising
from gazelle_ros.launch.errors import LaunchError
from gazelle_ros.launch.values import parse_yaml, parse_yaml_documents
from gazelle_ros.tools import params

NS = "_ns"


class RosParamException(Exception):  # noqa: N818  # rosparam's names
    """Root of the errors about parameters."""


class RosParamIOException(RosParamException):
    """The master does not answer."""


def get_param_server() -> Master:
    """Return the master; its methods raise rosgraph's errors."""
    return Master(f"rosparam-{os.getpid()}")


@raising(RosParamIOException)
def get_param(param: str) -> Any:
    """Return the value of a parameter.

    Raises:
        MasterError: It is not set.
    """
    return get_param_server().getParam(param)


@raising(RosParamIOException)
def list_params(ns: str) -> list[str]:
    """Return names of the parameters in a namespace."""
    space = make_global_ns(ns)
    return sorted(name for name in get_param_server().getParamNames() if name.startswith(space))


@raising(RosParamIOException)
def set_param_raw(param: str, value: Any, verbose: bool = False) -> None:  # noqa: FBT001, FBT002  # rosparam's interface
    """Set a parameter; a dict is merged into what is there, one parameter after another.

    Raises:
        MasterError: The master does not take the value there.
        TypeError: XML-RPC has no such values.
        OverflowError: A number does not fit.
        RosParamException: A key of a dict is no text.
    """
    if not isinstance(value, dict):
        get_param_server().setParam(param, value)
        if verbose:
            sys.stdout.write(f"set parameter [{param}] to [{value}]\n")
        return
    for key, inner in value.items():
        if not isinstance(key, str):
            raise RosParamException(
                f"YAML dictionaries must have string keys. Invalid dictionary is:\n{value}"
            )
        set_param_raw(names.join(param, key), inner, verbose)


def set_param(param: str, value: str, verbose: bool = False) -> None:  # noqa: FBT001, FBT002  # rosparam's interface
    """Set a parameter to a YAML text.

    Raises:
        YAMLError: It is not YAML.
        RosParamException: An angle in it is none.
        Exception: The value cannot be set; see `set_param_raw`.
    """
    set_param_raw(param, _parsed(parse_yaml, value), verbose)


def _parsed(parse: Callable[[str], Any], text: str) -> Any:
    try:
        return parse(text)
    except LaunchError as error:  # an angle that is none
        raise RosParamException(str(error)) from None


def upload_params(ns: str, values: Any, verbose: bool = False) -> None:  # noqa: FBT001, FBT002  # rosparam's interface
    """Set all parameters of a dict below a namespace, each for itself.

    Raises:
        RosParamException: A namespace is set to what is no dict.
        Exception: A value cannot be set; see `set_param_raw`.
    """
    if ns == "/" and not isinstance(values, dict):
        raise RosParamException("global / can only be set to a dictionary")
    set_param_raw(ns, values, verbose)


@raising(RosParamIOException)
def delete_param(param: str, verbose: bool = False) -> None:  # noqa: FBT001, FBT002  # rosparam's interface
    """Remove a parameter; ``/`` removes all.

    Raises:
        MasterError: It is not set.
    """
    if param == "/":
        get_param_server().setParam("/", {})
    else:
        get_param_server().deleteParam(param)
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
        YAMLError: It is not YAML.
    """
    del verbose, filename
    base = default_namespace or get_ros_namespace()
    found = []
    for document in _parsed(parse_yaml_documents, str):
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
        RosParamException: It cannot be read.
        YAMLError: It is not YAML.
    """
    try:
        text = sys.stdin.read() if filename == "-" else Path(filename).read_text(encoding="utf-8")
    except OSError as error:
        raise RosParamException(f"file [{filename}] does not exist: {error.strerror}") from None
    except UnicodeDecodeError as error:
        raise RosParamException(f"file [{filename}] is no text in UTF-8: {error.reason}") from None
    return load_str(text, filename, default_namespace, verbose)


def dump_params(filename: str | None, param: str, verbose: bool = False) -> None:  # noqa: FBT001, FBT002  # rosparam's interface
    """Write a namespace as YAML to a file, or to standard output.

    Raises:
        MasterError: It is not set.
        OSError: The file cannot be written.
    """
    del verbose
    text = params.as_document(get_param(param))
    if filename:
        write_text(filename, text)
    else:
        sys.stdout.write(text)


def yamlmain(argv: Sequence[str] | None = None) -> None:
    """Run rosparam's command line; see `gazelle_ros.compat.commands.run`.

    Args:
        argv: The command line, by default this process's.

    Raises:
        SystemExit: It failed.
    """
    commands.run("param", argv)


def _fullusage() -> None:
    """Print the usage, and end the process."""
    yamlmain(["rosparam", "--help"])
    raise SystemExit(0)
