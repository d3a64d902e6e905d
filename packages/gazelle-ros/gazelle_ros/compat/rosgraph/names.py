"""Rules of graph resource names, with rosgraph's functions."""

from __future__ import annotations

import os
import re
import socket
import sys
from collections.abc import Iterable, Mapping
from typing import Any

from gazelle_ros import names

MSG_EXT = ".msg"
SRV_EXT = ".srv"
SEP = "/"
GLOBALNS = "/"
PRIV_NAME = "~"
REMAP = ":="
ANYTYPE = "*"
ROS_NAMESPACE = "ROS_NAMESPACE"
NAME_LEGAL_CHARS_P = re.compile(r"^[\~\/A-Za-z][\w\/]*$")
BASE_NAME_LEGAL_CHARS_P = re.compile(r"^[A-Za-z][\w]*$")
REMAP_PATTERN = re.compile(r"^([\~\/A-Za-z]|_|__)[\w\/]*" + REMAP + ".*")

is_global = names.is_global
is_private = names.is_private
ns_join = names.join


def isstring(s: Any) -> bool:
    """Return whether a value is a string."""
    return isinstance(s, str)


def canonicalize_name(name: str) -> str:
    """Return the name without doubled or trailing slashes."""
    return names.canonical(name) if name else name


def make_global_ns(name: str) -> str:
    """Return a namespace with slashes at both ends.

    Raises:
        ValueError: The name is private.
    """
    if is_private(name):
        raise ValueError(f"cannot turn [{name}] into a global name")
    return names.as_namespace(name)


def namespace(name: str) -> str:
    """Return the namespace of a global name, with a slash at the end.

    Raises:
        TypeError: It is no string.
    """
    if not isinstance(name, str):
        raise TypeError("name")
    return names.namespace_of(name)


def get_ros_namespace(
    env: Mapping[str, str] | None = None, argv: Iterable[str] | None = None
) -> str:
    """Return the namespace of this process: ``__ns:=``, else ROS_NAMESPACE, else the root."""
    for argument in sys.argv if argv is None else argv:
        if argument.startswith("__ns:="):
            return make_global_ns(argument[len("__ns:=") :])
    found = (os.environ if env is None else env).get(ROS_NAMESPACE, GLOBALNS)
    return make_global_ns(found)


def make_caller_id(name: str) -> str:
    """Return a node's global name from its base name."""
    return make_global_ns(ns_join(get_ros_namespace(), name))[:-1]


def load_mappings(argv: Iterable[str]) -> dict[str, str]:
    """Load the remappings of a command line, unresolved.

    Without private parameters (``_p:=1``).
    """
    found = names.split_arguments(argv)[1]
    return {old: new for old, new in found.items() if new and (old[0] != "_" or old[:2] == "__")}


def is_legal_name(name: str) -> bool:
    """Return whether a name is legal; the empty one is."""
    if name is None:
        return False  # type: ignore[unreachable]
    return not name or names.is_legal(name)


def is_legal_base_name(name: str) -> bool:
    """Return whether a name is legal and has no namespace."""
    return name is not None and names.is_legal_base(name)


def is_legal_remap(arg: str) -> bool:
    """Return whether an argument is a remapping."""
    return bool(arg) and REMAP_PATTERN.match(arg) is not None


def resolve_name(name: str, namespace_: str, remappings: Mapping[str, str] | None = None) -> str:
    """Return the global name of a name for the node `namespace_`."""
    return names.resolve(name, namespace_, remappings)


def script_resolve_name(script_name: str, name: str) -> str:
    """Return the global name of a name for a script that is no node."""
    if not name:
        return get_ros_namespace()
    if is_global(name):
        return name
    if is_private(name):
        return ns_join(make_caller_id(script_name), name[1:])
    return get_ros_namespace() + name


def anonymous_name(id: str) -> str:  # noqa: A002  # rosgraph's interface
    """Return a unique name."""
    import random

    name = f"{id}_{socket.gethostname()}_{os.getpid()}_{random.randint(0, sys.maxsize)}"  # noqa: S311  # not a secret
    return re.sub(r"[.:-]", "_", name)
