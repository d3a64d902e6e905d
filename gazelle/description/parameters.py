"""A plugin's XML, kept whole and read by type.

Plugins have tags that only they know. They are kept as a tree of elements that is
independent of any XML library, and read with ``parameters.get("wheelSeparation", 0.34)``,
where the type of the default decides how the text is read.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import TypeVar

from gazelle.description.mappings import HoldsMappings
from gazelle.description.source import Source
from gazelle.errors import FormatError

T = TypeVar("T", bool, int, float, str)

_TRUE = {"true", "1", "yes", "on"}
_FALSE = {"false", "0", "no", "off"}


_NOTHING: Mapping[str, str] = MappingProxyType({})  # one for all, as there are many


@dataclass(frozen=True, slots=True)
class Parameters(HoldsMappings):
    """One XML element: its tag, attributes, text and children.

    Attributes:
        tag: Name without namespace.
        text: The text before the first child, stripped.
        attributes: Attribute values by name.
        children: Child elements in file order.
        source: Place of the element.
    """

    tag: str
    text: str = ""
    attributes: Mapping[str, str] = field(default_factory=lambda: _NOTHING)
    children: tuple[Parameters, ...] = ()
    source: Source | None = field(default=None, compare=False, repr=False)

    def find(self, tag: str) -> Parameters | None:
        """Return the first child with that tag, or None. ``a/b`` goes down two levels."""
        head, _, rest = tag.partition("/")
        for child in self.children:
            if child.tag == head:
                return child.find(rest) if rest else child
        return None

    def find_all(self, tag: str) -> Iterator[Parameters]:
        """Return all children with that tag, in file order."""
        return (child for child in self.children if child.tag == tag)

    def __contains__(self, tag: object) -> bool:
        return isinstance(tag, str) and self.find(tag) is not None

    def get(self, tag: str, default: T) -> T:
        """Return the value of a child, as the default's type; the default if absent or empty.

        Raises:
            FormatError: The text is not of that type.
        """
        child = self.find(tag)
        if child is None or not child.text:
            return default
        return child.value(type(default))

    def require(self, tag: str, kind: type[T]) -> T:
        """Return the value of a child that must be there.

        Raises:
            FormatError: The child is missing, empty, or not of that type.
        """
        child = self.find(tag)
        if child is None or not child.text:
            raise FormatError(f"a <{tag}> is required here", source=self.source)
        return child.value(kind)

    def value(self, kind: type[T]) -> T:
        """Return the text as bool, int, float or str.

        Raises:
            FormatError: The text is not of that type.
        """
        try:
            return kind(_READ[kind](self.text))
        except ValueError:
            expected = {bool: "true or false", int: "an int", float: "a number"}[kind]
            raise FormatError(
                f"expected {expected} in <{self.tag}>, found '{self.text}'", source=self.source
            ) from None

    def numbers(self, tag: str, default: tuple[float, ...]) -> tuple[float, ...]:
        """Return numbers separated by spaces in a child; the default, NaN too, if absent or empty.

        Raises:
            FormatError: They are not numbers, or not as many as in the default.
        """
        child = self.find(tag)
        if child is None or not child.text:
            return default
        try:
            values = tuple(map(_read_number, child.text.split()))
        except ValueError:
            values = ()
        if len(values) != len(default):
            raise FormatError(
                f"expected {len(default)} numbers in <{tag}>, found '{child.text}'",
                source=child.source,
            )
        return values


def _read_bool(text: str) -> bool:
    word = text.strip().lower()
    if word in _TRUE:
        return True
    if word in _FALSE:
        return False
    raise ValueError(text)


def _read_number(text: str) -> float:
    number = float(text)
    if math.isnan(number):
        raise ValueError(text)
    return number


_READ: Mapping[type, Callable[[str], bool | int | float | str]] = {
    bool: _read_bool,
    int: int,
    float: _read_number,
    str: str,
}
"""Readers of texts by type."""
