"""Private parameters of a node as a dataclass of settings."""

from __future__ import annotations

from collections.abc import Collection
from typing import Any

from gazelle_ros.base.parameter_values import Settings, settings_from, warn_of_unknown
from gazelle_ros.node import Node


def private_values(node: Node) -> dict[str, Any]:
    """Return all private parameters of a node, nested."""
    found = node.get_param(node.resolve("~"), {})
    return found if isinstance(found, dict) else {}


def warn_of_others(node: Node, known: Collection[str]) -> None:
    """Warn of the private parameters of a node that are not known."""
    warn_of_unknown(node.resolve("~"), private_values(node), known)


def settings_of(node: Node, kind: type[Settings], *, others: Collection[str] = ()) -> Settings:
    """Return a dataclass of the private parameters; those that are not set have its defaults.

    Args:
        node: On the graph. Private parameters that it does not know are warned of.
        kind: The dataclass; its fields are called as the parameters.
        others: Parameters that are read elsewhere.

    Raises:
        Error: A parameter is of another kind than its default.
    """
    return settings_from(node.resolve("~"), private_values(node), kind, others=others)
