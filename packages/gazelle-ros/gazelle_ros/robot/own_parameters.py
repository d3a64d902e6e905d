"""Private parameters of the publishers of a robot's state."""

from __future__ import annotations

from collections.abc import Collection
from typing import TYPE_CHECKING

from gazelle_ros.base.parameter_values import Values, warn_of_unknown

if TYPE_CHECKING:
    from gazelle_ros.node import Node


def own_parameters(node: Node, known: Collection[str]) -> Values:
    """Return the private parameters of a node, and warn of those that are not known."""
    found = node.get_param(node.resolve("~"), {})
    values: Values = found if isinstance(found, dict) else {}
    warn_of_unknown(node.resolve("~"), values, known)
    return values
