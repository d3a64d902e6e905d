"""Names as this process sees them: remappings of its command line, its node, its namespace."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable
from typing import Any

from gazelle_ros import names
from gazelle_ros.compat.rosgraph.names import (
    ANYTYPE,
    GLOBALNS,
    PRIV_NAME,
    REMAP,
    ROS_NAMESPACE,
    SEP,
    canonicalize_name,
    get_ros_namespace,
    is_global,
    is_legal_name,
    is_private,
    load_mappings,
    make_global_ns,
    namespace,
    ns_join,
)

TOPIC_ANYTYPE = ANYTYPE
SERVICE_ANYTYPE = ANYTYPE

__all__ = [
    "ANYTYPE",
    "GLOBALNS",
    "PRIV_NAME",
    "REMAP",
    "ROS_NAMESPACE",
    "SEP",
    "SERVICE_ANYTYPE",
    "TOPIC_ANYTYPE",
    "canonicalize_name",
    "get_caller_id",
    "get_mappings",
    "get_name",
    "get_namespace",
    "get_resolved_mappings",
    "get_ros_namespace",
    "global_name",
    "initialize_mappings",
    "is_global",
    "is_private",
    "isstring",
    "load_mappings",
    "make_global_ns",
    "namespace",
    "ns_join",
    "reload_mappings",
    "remap_name",
    "resolve_name",
    "resolve_name_without_node_name",
    "scoped_name",
    "valid_name",
]

UNNAMED = "/unnamed"


class _Identity:
    """Identity of this process; empty before `init_node`."""

    def __init__(self) -> None:
        self.reload(sys.argv)

    def reload(self, argv: Iterable[str]) -> None:
        words = list(argv)
        self.assigned: dict[str, str] = names.split_arguments(words)[1]
        self.mappings: dict[str, str] = load_mappings(words)
        self.resolved: dict[str, str] = {}
        space = self.mappings.get("__ns") or os.environ.get(ROS_NAMESPACE, GLOBALNS)
        self.namespace = names.as_namespace(space)
        self.caller = UNNAMED


identity = _Identity()


def isstring(value: Any) -> bool:
    """Return whether a value is a string."""
    return isinstance(value, str)


def get_caller_id() -> str:
    """Return the global name of this node."""
    return identity.caller


get_name = get_caller_id


def get_namespace() -> str:
    """Return the namespace of this node, with slashes at both ends."""
    return identity.namespace


def get_mappings() -> dict[str, str]:
    """Return the remappings of the command line, as given."""
    return identity.mappings


def get_resolved_mappings() -> dict[str, str]:
    """Return the remappings, with both sides resolved for the node."""
    return identity.resolved


def reload_mappings(argv: Iterable[str]) -> None:
    """Set remappings and namespace from another command line."""
    identity.reload(argv)


def initialize_mappings(node_name: str) -> None:
    """Resolve the remappings for the node of this name."""
    identity.caller = node_name
    identity.resolved = names.resolve_remappings(identity.mappings, node_name)


def _set_caller_id(caller_id: str) -> None:
    identity.caller = caller_id
    identity.namespace = names.namespace_of(caller_id)


def resolve_name(name: str, caller_id: str | None = None) -> str:
    """Return the global name of a name for this node (or another), remapped."""
    if not caller_id:
        caller_id = _own_name()
    if not name:
        return names.namespace_of(caller_id)
    name = canonicalize_name(name)
    resolved = names.resolve(name, caller_id)
    mapped = identity.resolved or names.resolve_remappings(identity.mappings, _own_name())
    return mapped.get(resolved, resolved)


def _own_name() -> str:
    if identity.caller == UNNAMED:
        return identity.namespace + UNNAMED[1:]
    return identity.caller


def resolve_name_without_node_name(name: str) -> str:
    """Return the same as `resolve_name`, before the node has a name.

    Raises:
        ValueError: The name is private.
    """
    if is_private(name):
        raise ValueError(
            "~name topics cannot be created before init_node() has been called; "
            f"the offending name is '{name}'"
        )
    return resolve_name(name)


def remap_name(name: str, caller_id: str | None = None, resolved: bool = True) -> str:  # noqa: FBT001, FBT002  # rospy's interface
    """Return the remapped name; the name itself if it is not remapped."""
    if not caller_id:
        caller_id = _own_name()
    if name in identity.mappings:
        target = identity.mappings[name]
        return names.resolve(target, caller_id) if resolved else target
    return name


def scoped_name(caller_id: str, name: str) -> str:
    """Return a global name as seen from a node's namespace."""
    if not is_global(caller_id):
        raise ValueError(f"caller_id must be global: {caller_id}")
    space = names.namespace_of(caller_id)
    if space != GLOBALNS and name.startswith(space):
        return name[len(space) :]
    return name if not is_global(name) else name.rstrip(SEP) or SEP


def global_name(name: str) -> str:
    """Return the name with a slash in front."""
    return name if is_global(name) else SEP + name


def valid_name(param_name: str, resolve: bool = True) -> Any:  # noqa: FBT001, FBT002  # rospy's interface
    """Return a check of a parameter: a function of its value and the caller."""

    def check(value: Any, caller_id: str) -> str:
        if not isinstance(value, str) or not value or not is_legal_name(value):
            raise ValueError(f"ERROR: parameter [{param_name}] must be a legal name")
        return resolve_name(value, caller_id) if resolve else value

    return check
