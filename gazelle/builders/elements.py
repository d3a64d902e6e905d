"""XML elements made by code, one keyword a child."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from gazelle.builders.errors import BuildError
from gazelle.description import Parameters, Pose
from gazelle.errors import FormatError
from gazelle.formats.write.element import written

Value = str | bool | float | Pose | tuple[float, ...]


def element(
    tag: str,
    value: Value | None = None,
    *children: Parameters,
    attributes: Mapping[str, Value] | None = None,
) -> Parameters:
    """Return an element with a value, or with children, and attributes.

    Raises:
        BuildError: A number is not a number.
    """
    own = {name: text_of(each) for name, each in (attributes or {}).items()}
    text = "" if value is None else text_of(value)
    return Parameters(tag, text, MappingProxyType(own), children)


def group(tag: str, **values: Value | Parameters | None) -> Parameters:
    """Return an element with one child a keyword; a child that is None is left out."""
    children = [
        each if isinstance(each, Parameters) else element(name, each)
        for name, each in values.items()
        if each is not None
    ]
    return element(tag, None, *children)


def text_of(value: Value) -> str:
    """Return a value as the writers of SDF and URDF write it; a pose in angles.

    Raises:
        BuildError: A number is not a number.
    """
    plain = (*value.position, *value.rpy) if isinstance(value, Pose) else value
    try:
        return written(plain)
    except FormatError:
        raise BuildError("a value is not a number") from None
