"""Graph resource names: validation, resolution and remapping.

Rules: http://wiki.ros.org/Names and http://wiki.ros.org/Remapping%20Arguments.
"""

from __future__ import annotations

import os
import re
import time
from collections.abc import Iterable, Mapping

from gazelle_ros.errors import InvalidNameError

SEPARATOR = "/"
PRIVATE = "~"
REMAP = ":="
ANY_TYPE = "*"

_LEGAL = re.compile(r"[~/A-Za-z][\w/]*", re.ASCII)
_LEGAL_BASE = re.compile(r"[A-Za-z]\w*", re.ASCII)


def is_legal(name: str) -> bool:
    """Return True if `name` may name a node, topic, service or parameter."""
    return bool(_LEGAL.fullmatch(name)) and "//" not in name


def is_legal_base(name: str) -> bool:
    """Return True if `name` is legal and has no namespace."""
    return bool(_LEGAL_BASE.fullmatch(name))


def check(name: str) -> str:
    """Return `name`.

    Raises:
        InvalidNameError: It is not legal.
    """
    if not is_legal(name):
        raise InvalidNameError(
            f"'{name}' is not a legal name",
            hint="names hold letters, digits, '_' and '/', and start with a letter, '/' or '~'",
        )
    return name


def canonical(name: str) -> str:
    """Return `name` without doubled or trailing slashes; a lone slash stays."""
    if name in {"", SEPARATOR}:
        return name
    start = SEPARATOR if name[0] == SEPARATOR else ""
    return start + SEPARATOR.join(part for part in name.split(SEPARATOR) if part)


def is_global(name: str) -> bool:
    """Return True for names like ``/a``."""
    return name.startswith(SEPARATOR)


def is_private(name: str) -> bool:
    """Return True for names like ``~a``."""
    return name.startswith(PRIVATE)


def namespace_of(name: str) -> str:
    """Return the namespace of a global name, with a slash at the end: ``/a/b`` gives ``/a/``."""
    if not name:
        return SEPARATOR
    return name.rstrip(SEPARATOR).rpartition(SEPARATOR)[0] + SEPARATOR


def join(namespace: str, name: str) -> str:
    """Return `name` seen from `namespace`; global and private names stay as they are."""
    if not namespace or is_global(name) or is_private(name):
        return name
    if namespace == PRIVATE:
        return PRIVATE + name
    return namespace.rstrip(SEPARATOR) + SEPARATOR + name


def as_namespace(text: str) -> str:
    """Return a user's namespace (``ns1``, ``/ns1/``, ``""``) with slashes at both ends."""
    name = canonical(text)
    if name in {"", SEPARATOR}:
        return SEPARATOR
    return (name if is_global(name) else SEPARATOR + name) + SEPARATOR


def resolve(name: str, node: str, remappings: Mapping[str, str] | None = None) -> str:
    """Return the global name of `name` for the node called `node`.

    Args:
        name: Any name; empty means the node's namespace.
        node: The node's global name, such as ``/ns/talker``.
        remappings: From global names to global names.
    """
    if not name:
        return namespace_of(node)
    name = canonical(name)
    if is_global(name):
        resolved = name
    elif is_private(name):
        resolved = canonical(node + SEPARATOR + name[1:])
    else:
        resolved = namespace_of(node) + name
    return remappings.get(resolved, resolved) if remappings else resolved


def resolve_remappings(mappings: Mapping[str, str], node: str) -> dict[str, str]:
    """Return remappings of a command line, with both sides resolved for the node.

    Keys that start with ``_`` are private parameters (``_rate``) or special keys
    (``__name``) and are left out.
    """
    return {
        resolve(old, node): resolve(new, node)
        for old, new in mappings.items()
        if not old.startswith("_")
    }


def split_arguments(arguments: Iterable[str]) -> tuple[list[str], dict[str, str]]:
    """Return separate plain arguments from ``old:=new``.

    Returns:
        The plain arguments, and the remappings from old to new, unresolved.
    """
    plain: list[str] = []
    mappings: dict[str, str] = {}
    for argument in arguments:
        old, remap, new = argument.partition(REMAP)
        if not remap:
            plain.append(argument)
        elif old.strip():
            mappings[old.strip()] = new.strip()
    return plain, mappings


def anonymous(base: str) -> str:
    """Return a unique name: `base`, the process and the time in milliseconds."""
    return f"{base}_{os.getpid()}_{int(time.time() * 1000)}"
