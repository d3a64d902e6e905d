"""What SDF allows: a walk over a file that finds wrong types, missing and unknown names.

``schema.json`` is the union of SDF 1.4 to 1.12, written by ``tools/build_sdf_schema.py``.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from importlib import resources
from typing import Any

from gazelle.description import Parameters
from gazelle.errors import FormatError, did_you_mean
from gazelle.formats import values
from gazelle.formats.reading import Reading

_OPAQUE = {"plugin", "actor", "gui", "state", "population", "include", "pose", "model_state"}
"""Kept whole, or read by code that knows more than the schema does."""


@cache
def types() -> dict[str, dict[str, Any]]:
    """The schema: attributes, children and type of value by kind of element."""
    text = (resources.files(__package__) / "schema.json").read_text()
    loaded: dict[str, dict[str, Any]] = json.loads(text)
    return loaded


def check(node: Parameters, kind: str, reading: Reading) -> None:
    """Judge an element and all below it.

    Unknown elements become notes of the reading.

    Raises:
        FormatError: A value has the wrong type, or a required attribute is missing.
    """
    entry = types().get(kind)
    if entry is None:
        return
    for name, (type_name, required) in entry["attributes"].items():
        if required and name not in node.attributes:
            raise values.fail(node, f"the attribute '{name}' is required in <{node.tag}>")
        text = node.attributes.get(name, "")
        if text and type_name in _CHECKS:
            _CHECKS[type_name](node, text, f"attribute '{name}'")
    checker = _CHECKS.get(entry["type"])
    if checker is not None and node.text:
        checker(node, node.text, f"<{node.tag}>")
    _check_children(node, entry, reading)


def _check_children(node: Parameters, entry: dict[str, Any], reading: Reading) -> None:
    allowed = entry["children"]
    for child in node.children:
        known = allowed.get(child.tag)
        if known is None:
            _note_unknown(child, node, allowed, reading)
        elif known[0] == "inertial":
            # read where it is known whether the model is static, and it does not matter
            with suppress(FormatError):
                check(child, known[0], reading)
        elif known[0] not in _OPAQUE:
            check(child, known[0], reading)


def _note_unknown(
    child: Parameters, node: Parameters, allowed: dict[str, Any], reading: Reading
) -> None:
    if ":" in child.tag:
        return  # another tool's namespace: SDF lets it stand anywhere
    reading.note(
        f"<{child.tag}> is not an SDF element of <{node.tag}> and was ignored",
        child,
        did_you_mean(child.tag, allowed),
    )


def _vector(node: Parameters, text: str, what: str) -> None:
    values.parse_reals(node, text, what, 3)


def _pair(node: Parameters, text: str, what: str) -> None:
    values.parse_reals(node, text, what, 2)


_CHECKS: dict[str, Callable[[Parameters, str, str], object]] = {
    "double": values.parse_real,
    "float": values.parse_real,
    "int": values.parse_integer,
    "unsigned int": values.parse_integer,
    "bool": values.parse_flag,
    "vector3": _vector,
    "vector2d": _pair,
    "color": lambda node, text, _: values.parse_color(node, text),
}
