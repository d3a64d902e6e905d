"""Typed values out of XML elements, with errors that name the place.

Every function raises ``FormatError`` with file, line and element when the text is not of
the requested type.
"""

from __future__ import annotations

import math
import re

from gazelle.description import Color, Parameters, Vector3
from gazelle.errors import FormatError
from gazelle_ros.base.characters import curly_hint

INFINITE = 1e16
"""SDF writes "no limit" as a number at least this large."""

UNIT = 1e-14
"""A length that differs from one by less does so from rounding."""

_NUMBER = re.compile(
    r"[+-]?(\d+\.?\d*([eE][+-]?\d+)?|\.\d+([eE][+-]?\d+)?|inf(inity)?)", re.IGNORECASE
)
_TRUE = {"true", "1"}
_FALSE = {"false", "0"}


def fail(node: Parameters, message: str, *, hint: str | None = None) -> FormatError:
    """Return the error to raise about an element."""
    return FormatError(message, source=node.source, hint=hint)


def parse_real(node: Parameters, text: str, what: str) -> float:
    """Parse text as a number; ``what`` names it in the error."""
    word = text.strip()
    if not _NUMBER.fullmatch(word):
        raise fail(node, f"expected a number in {what}, found '{word}'", hint=curly_hint(word))
    return float(word)


def parse_reals(node: Parameters, text: str, what: str, count: int | None) -> tuple[float, ...]:
    """Parse text as numbers separated by spaces; any number of them when ``count`` is None."""
    words = text.split()
    if count is not None and len(words) != count:
        raise fail(node, f"expected {count} numbers in {what}, found '{text.strip()}'")
    return tuple(parse_real(node, word, what) for word in words)


def parse_integer(node: Parameters, text: str, what: str) -> int:
    """Parse text as an int; hexadecimal and a fraction of zero are accepted."""
    word = text.strip()
    try:
        return int(word, 16) if word.lower().startswith("0x") else int(word.rstrip("uU"))
    except ValueError:
        value = parse_real(node, word, what)
    if not math.isfinite(value):
        raise fail(node, f"expected an int in {what}, found '{word}'")
    return int(value)


def parse_flag(node: Parameters, text: str, what: str) -> bool:
    """Parse text as true or false."""
    word = text.strip().lower()
    if word in _TRUE:
        return True
    if word in _FALSE:
        return False
    raise fail(node, f"expected true or false in {what}, found '{text.strip()}'")


def attribute(node: Parameters, name: str) -> str:
    """Return an attribute that must exist and not be empty."""
    value = node.attributes.get(name, "")
    if not value:
        raise fail(node, f"the attribute '{name}' is required in <{node.tag}>")
    return value


def attribute_real(node: Parameters, name: str, default: float | None = None) -> float:
    """Return a numeric attribute; required when there is no default."""
    if default is not None and not node.attributes.get(name, "").strip():
        return default
    return parse_real(node, attribute(node, name), f"attribute '{name}'")


def attribute_vector(node: Parameters, name: str, default: Vector3) -> Vector3:
    """Return an attribute of three numbers."""
    text = node.attributes.get(name, "")
    if not text.strip():
        return default
    x, y, z = parse_reals(node, text, f"attribute '{name}'", 3)
    return (x, y, z)


def _text(node: Parameters, path: str) -> tuple[Parameters, str] | None:
    child = node.find(path)
    return None if child is None or not child.text else (child, child.text)


def real(node: Parameters, path: str, default: float) -> float:
    """Return a number in a child."""
    found = _text(node, path)
    return default if found is None else parse_real(found[0], found[1], f"<{found[0].tag}>")


def limit(node: Parameters, path: str, default: float) -> float:
    """Return a number in a child, where 1e16 and more stands for infinity."""
    value = real(node, path, default)
    return math.copysign(math.inf, value) if abs(value) >= INFINITE else value


def whole(node: Parameters, path: str, default: int) -> int:
    """Return an int in a child."""
    found = _text(node, path)
    return default if found is None else parse_integer(found[0], found[1], f"<{found[0].tag}>")


def flag(node: Parameters, path: str, *, default: bool) -> bool:
    """Return True or false in a child."""
    found = _text(node, path)
    return default if found is None else parse_flag(found[0], found[1], f"<{found[0].tag}>")


def word(node: Parameters, path: str, default: str = "") -> str:
    """Return text in a child."""
    found = _text(node, path)
    return default if found is None else found[1]


def vector(node: Parameters, path: str, default: Vector3) -> Vector3:
    """Return three numbers in a child."""
    found = _text(node, path)
    if found is None:
        return default
    x, y, z = parse_reals(found[0], found[1], f"<{found[0].tag}>", 3)
    return (x, y, z)


def color(node: Parameters, path: str, default: Color) -> Color:
    """Return red, green, blue and perhaps alpha in a child."""
    found = _text(node, path)
    return default if found is None else parse_color(found[0], found[1])


def parse_color(node: Parameters, text: str) -> Color:
    """Parse three or four numbers as a colour; alpha is 1 when it is left out."""
    numbers = parse_reals(node, text, f"<{node.tag}>", None)
    if len(numbers) == 3:
        numbers = (*numbers, 1.0)
    if len(numbers) != 4:
        raise fail(node, f"expected 3 or 4 numbers in <{node.tag}>, found '{text}'")
    return (numbers[0], numbers[1], numbers[2], numbers[3])


def positive(node: Parameters, value: float, what: str) -> float:
    """Return the value, which must be finite and greater than zero."""
    if not (value > 0.0 and math.isfinite(value)):
        raise fail(node, f"{what} must be greater than zero, found {value:g}")
    return value


def unit(node: Parameters, xyz: Vector3) -> Vector3:
    """Return the vector at length one; one that has it already keeps its numbers."""
    length = math.sqrt(sum(c * c for c in xyz))
    if not math.isfinite(length) or length == 0.0:
        raise fail(node, f"<{node.tag}> must be a vector of some length, found {xyz}")
    if abs(length - 1.0) < UNIT:
        return xyz
    return (xyz[0] / length, xyz[1] / length, xyz[2] / length)
