"""Names of nodes, topics and types, where roslib keeps them."""

from __future__ import annotations

from gazelle_ros.compat.rosgraph.names import (
    ANYTYPE,
    GLOBALNS,
    PRIV_NAME,
    REMAP,
    SEP,
    anonymous_name,
    canonicalize_name,
    get_ros_namespace,
    is_global,
    is_legal_base_name,
    is_legal_name,
    is_private,
    load_mappings,
    make_caller_id,
    make_global_ns,
    namespace,
    ns_join,
    resolve_name,
    script_resolve_name,
)

PRN_SEPARATOR = TYPE_SEPARATOR = "/"

__all__ = [
    "ANYTYPE",
    "GLOBALNS",
    "PRIV_NAME",
    "PRN_SEPARATOR",
    "REMAP",
    "SEP",
    "TYPE_SEPARATOR",
    "anonymous_name",
    "canonicalize_name",
    "get_ros_namespace",
    "is_global",
    "is_legal_base_name",
    "is_legal_name",
    "is_private",
    "load_mappings",
    "make_caller_id",
    "make_global_ns",
    "namespace",
    "ns_join",
    "package_resource_name",
    "resolve_name",
    "resource_name",
    "resource_name_base",
    "resource_name_package",
    "script_resolve_name",
]


def package_resource_name(name: str) -> tuple[str, str]:
    """Return package and base of a type's name; the package is empty if there is none.

    Raises:
        ValueError: It has more than two parts.
    """
    parts = name.split(PRN_SEPARATOR)
    if len(parts) > 2:
        raise ValueError(f"invalid name [{name}]")
    return (parts[0], parts[1]) if len(parts) == 2 else ("", name)


def resource_name(res_pkg_name: str, name: str, my_pkg: str | None = None) -> str:
    """Return the full name of a type; short if it is of one's own package."""
    if res_pkg_name and res_pkg_name != my_pkg:
        return f"{res_pkg_name}{PRN_SEPARATOR}{name}"
    return name


def resource_name_base(name: str) -> str:
    """Return the name without its package."""
    return name.rpartition(PRN_SEPARATOR)[2]


def resource_name_package(name: str) -> str | None:
    """Return the package of a name; None if it has none."""
    return name.partition(PRN_SEPARATOR)[0] if PRN_SEPARATOR in name else None
