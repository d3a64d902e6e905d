"""Check against SDF's schema: wrong types, missing and unknown names.

``schema.json`` is the union of SDF 1.4 to 1.12, written by ``tools/build_sdf_schema.py``.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from functools import cache
from importlib import resources
from typing import Any

from gazelle.description import Parameters
from gazelle.errors import FormatError, did_you_mean
from gazelle.formats import values
from gazelle.formats.reading import Reading
from gazelle.formats.sdf import lenient

_OPAQUE = {"plugin", "actor", "gui", "state", "population", "include", "pose", "model_state"}
"""Kept whole, or read by code that knows more than the schema does."""

_HOLDERS = {"insertions", "population"}
"""Elements of those that hold whole models."""


@cache
def types() -> dict[str, dict[str, Any]]:
    """Return the schema: attributes, children and type of value by kind of element."""
    text = (resources.files(__package__) / "schema.json").read_text()
    loaded: dict[str, dict[str, Any]] = json.loads(text)
    return loaded


def checked(node: Parameters, kind: str, reading: Reading) -> Parameters:
    """Return an element with all below it; wrong values become those that Gazebo uses.

    Unknown elements and such values become notes of the reading.

    Raises:
        FormatError: A value cannot be made sense of, or a required attribute is missing.
    """
    entry = types().get(kind)
    if entry is None:
        return node
    node = _with_attributes(node, entry, reading)
    read = _VALUES.get(entry["type"])
    if read is not None and node.text:
        text = read(node, node.text, f"<{node.tag}>", reading)
        node = node if text is node.text else replace(node, text=text)
    node = with_children(node, lambda child: _child(child, node, entry["children"], reading))
    return lenient.part(node, reading)


def with_children(node: Parameters, change: Callable[[Parameters], Parameters]) -> Parameters:
    """Return the element with its children changed; the same object where none is."""
    children = tuple(map(change, node.children))
    same = all(new is old for new, old in zip(children, node.children, strict=True))
    return node if same else replace(node, children=children)


def _with_attributes(node: Parameters, entry: dict[str, Any], reading: Reading) -> Parameters:
    changed = {}
    for name, (type_name, required) in entry["attributes"].items():
        if required and name not in node.attributes:
            raise values.fail(node, f"the attribute '{name}' is required in <{node.tag}>")
        text = node.attributes.get(name, "")
        if text and type_name in _VALUES:
            taken = _VALUES[type_name](node, text, f"attribute '{name}'", reading)
            if taken is not text:
                changed[name] = taken
    return replace(node, attributes={**node.attributes, **changed}) if changed else node


def _child(
    child: Parameters, node: Parameters, allowed: dict[str, Any], reading: Reading
) -> Parameters:
    known = allowed.get(child.tag)
    if known is None:
        _note_unknown(child, node, allowed, reading)
        return child
    kind = known[0]
    if kind == "inertial":
        # read where it is known whether the model is static, and it does not matter
        with suppress(FormatError):
            return checked(child, kind, reading)
        return child
    return tolerated(child, reading) if kind in _OPAQUE else checked(child, kind, reading)


def tolerated(node: Parameters, reading: Reading) -> Parameters:
    """Return an element that the schema does not check, except poses and models in it."""
    if node.tag == "plugin":
        return node
    whole = {"model", "light"} if node.tag in _HOLDERS else set()
    node = with_children(
        node,
        lambda child: (
            checked(child, child.tag, reading) if child.tag in whole else tolerated(child, reading)
        ),
    )
    return lenient.part(node, reading)


def _note_unknown(
    child: Parameters, node: Parameters, allowed: dict[str, Any], reading: Reading
) -> None:
    if ":" in child.tag:
        return  # another tool's namespace: SDF allows it anywhere
    reading.note(
        f"<{child.tag}> is not an SDF element of <{node.tag}> and was ignored",
        child,
        did_you_mean(child.tag, allowed),
    )


_VALUES: dict[str, Callable[[Parameters, str, str, Reading], str]] = {
    "double": lenient.real,
    "float": lenient.real,
    "int": lenient.integer,
    "unsigned int": lenient.integer,
    "bool": lenient.flag,
    "vector3": lenient.vector(3),
    "vector2d": lenient.vector(2),
    "color": lenient.color,
}
