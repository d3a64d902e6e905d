"""XML elements made by code, and their text."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from xml.sax.saxutils import escape, quoteattr

from gazelle.builders.errors import BuildError
from gazelle.description import Parameters, Pose

Value = str | bool | float | Pose | tuple[float, ...]


def element(
    tag: str,
    value: Value | None = None,
    *children: Parameters,
    attributes: Mapping[str, Value] | None = None,
) -> Parameters:
    """An element with a value, or with children, and attributes.

    Raises:
        BuildError: A number is not a number.
    """
    own = {name: text_of(each) for name, each in (attributes or {}).items()}
    text = "" if value is None else text_of(value)
    return Parameters(tag, text, MappingProxyType(own), children)


def group(tag: str, **values: Value | Parameters | None) -> Parameters:
    """An element with one child a keyword; a child that is None is left out."""
    children = [
        each if isinstance(each, Parameters) else element(name, each)
        for name, each in values.items()
        if each is not None
    ]
    return element(tag, None, *children)


def text_of(value: Value) -> str:
    """A value as SDF and URDF write it: ``true``, shortest decimals, numbers apart by blanks.

    Raises:
        BuildError: A number is not a number.
    """
    if isinstance(value, str):
        return value
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, Pose):
        return text_of((*value.position, *value.rpy))
    if isinstance(value, tuple):
        return " ".join(text_of(each) for each in value)
    if value != value:  # noqa: PLR0124  NaN alone differs from itself
        raise BuildError("a value is not a number")
    return f"{value:d}" if isinstance(value, int) else repr(float(value)).removesuffix(".0")


def xml_of(node: Parameters, indent: str = "") -> str:
    """The text of an element, two blanks a level, with a line break at its end."""
    attributes = "".join(f" {name}={quoteattr(text)}" for name, text in node.attributes.items())
    start = f"{indent}<{node.tag}{attributes}"
    if not node.children:
        body = f">{escape(node.text)}</{node.tag}>" if node.text else "/>"
        return f"{start}{body}\n"
    inner = "".join(xml_of(child, f"{indent}  ") for child in node.children)
    text = f"{indent}  {escape(node.text)}\n" if node.text else ""
    return f"{start}>\n{text}{inner}{indent}</{node.tag}>\n"
