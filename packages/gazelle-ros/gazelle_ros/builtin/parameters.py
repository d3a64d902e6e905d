"""Private parameters of a node as a dataclass of settings."""

from __future__ import annotations

import logging
from collections.abc import Collection
from dataclasses import fields
from typing import Any, TypeVar

from gazelle_ros.base.errors import did_you_mean
from gazelle_ros.base.parameter_values import Values, fields_of
from gazelle_ros.node import Node

_LOG = logging.getLogger("gazelle.ros.parameters")

Settings = TypeVar("Settings")


def private_values(node: Node) -> dict[str, Any]:
    """Return all private parameters of a node, nested."""
    found = node.get_param(node.resolve("~"), {})
    return found if isinstance(found, dict) else {}


def settings_of(node: Node, kind: type[Settings], *, others: Collection[str] = ()) -> Settings:
    """Return a dataclass of the private parameters; those that are not set have its defaults.

    Args:
        node: On the graph. Private parameters that it does not know are warned of.
        kind: The dataclass; its fields are called as the parameters.
        others: Parameters that are read elsewhere.

    Raises:
        Error: A parameter is of another kind than its default.
    """
    values = private_values(node)
    known = [each.name for each in fields(kind)]  # type: ignore[arg-type]  # a dataclass
    warn_of_unknown(node.resolve("~"), values, {*known, *others})
    return kind(**fields_of(kind, values))


def warn_of_unknown(where: str, values: Values, known: Collection[str]) -> None:
    """Warn of parameters that are not known; namespaces may belong to another node.

    Args:
        where: Namespace of the parameters.
        values: The parameters.
        known: Names of those known.
    """
    for name, value in values.items():
        if name not in known and not isinstance(value, dict):
            hint = did_you_mean(name, known)
            _LOG.warning("%s/%s is an unknown parameter; %s", where, name, hint)
