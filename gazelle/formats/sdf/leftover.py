"""Remainder of an element that no field of a description holds, kept so that nothing is lost.

A pattern names what a reader takes out of an element: ``@name`` for an attribute, a tag for
a child, with None for a plain value and another pattern for a child that holds more.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TypeAlias

from gazelle.description import Parameters
from gazelle.formats.sdf.pose import QUATERNION

Pattern: TypeAlias = Mapping[str, "Pattern | None"]

_WHOLE = {"geometry", "lens", "material", "plugin"}
_READ_ATTRIBUTES = {
    "noise": {"type"},
    "pose": {"degrees", "frame", "relative_to", "rotation_format", QUATERNION},
}


def leftover(node: Parameters, pattern: Pattern) -> Parameters:
    """Return the element without the parts that a pattern names, and without parts that become empty."""
    taken = {key[1:] for key in pattern if key.startswith("@")}
    children = (
        _left(child, pattern[child.tag]) if child.tag in pattern else child
        for child in node.children
    )
    return replace(
        without(node, taken), text="", children=tuple(left for left in children if left is not None)
    )


def without(node: Parameters, names: set[str]) -> Parameters:
    """Return the element without some attributes."""
    if names.isdisjoint(node.attributes):
        return node
    kept = {name: text for name, text in node.attributes.items() if name not in names}
    return replace(node, attributes=kept)


def _left(node: Parameters, pattern: Pattern | None) -> Parameters | None:
    if pattern is not None:
        left = leftover(node, pattern)
    elif node.tag in _WHOLE:
        return None
    elif node.tag == "noise" and "custom" in {node.attributes.get("type"), node.get("type", "")}:
        return node  # made by a plugin, which may have parameters here
    else:
        left = without(node, _READ_ATTRIBUTES.get(node.tag, set()))
        left = replace(left, text="", children=())
    return left if left.children or left.attributes else None
