"""Values that are not of their type, as Gazebo reads them: as much of the text as is a number.

libsdformat 9, which Gazebo classic uses, reads a number as C's ``strtod`` does, which stops where
it ends (``1.5kg`` is 1.5), and a pose or vector out of a stream, which leaves alone what is more
and gives up where there is less. What Gazebo then takes for a vector that is too short, nothing
at all, is no help: here the given numbers are kept.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace

from gazelle.description import Parameters
from gazelle.errors import FormatError
from gazelle.formats import values
from gazelle.formats.reading import Reading
from gazelle.formats.sdf.build import made, with_attributes, with_child

_START = re.compile(r"[+-]?(\d+\.?\d*([eE][+-]?\d+)?|\.\d+([eE][+-]?\d+)?)")
_FACTORS = {"scale", "size"}
"""A single number in one of these stands for all directions."""
_POSE, _POSITION = 6, 3
_NOISES = {"", "custom", "gaussian", "gaussian_quantized", "none"}


def real(node: Parameters, text: str, what: str, reading: Reading) -> str:
    """Return a number: the beginning of the text.

    Raises:
        FormatError: It does not begin with a number.
    """
    try:
        values.parse_real(node, text, what)
    except FormatError as error:
        start = _START.match(text.strip())
        if start is None:
            raise
        reading.tolerate(error, f"{start[0]} was taken")
        return start[0]
    return text


def integer(node: Parameters, text: str, what: str, reading: Reading) -> str:
    """Return an int: the beginning of the text."""
    try:
        values.parse_integer(node, text, what)
    except FormatError:
        return real(node, text, what, reading)
    return text


def flag(node: Parameters, text: str, what: str, _: Reading) -> str:
    """Return true or false; nothing else is accepted.

    Raises:
        FormatError: It is neither.
    """
    values.parse_flag(node, text, what)
    return text


def vector(count: int) -> Callable[[Parameters, str, str, Reading], str]:
    """Return a reader of ``count`` numbers; missing ones are 0, and 1 in a ``<scale>``."""

    def read(node: Parameters, text: str, what: str, reading: Reading) -> str:
        try:
            values.parse_reals(node, text, what, count)
        except FormatError as error:
            found = _numbers(text)
            if not found:
                raise
            if len(found) == 1 and node.tag in _FACTORS:
                found *= count
            rest = ["1" if node.tag == "scale" else "0"] * (count - len(found))
            return _taken([*found, *rest][:count], error, reading)
        return text

    return read


def color(node: Parameters, text: str, _: str, reading: Reading) -> str:
    """Return three or four numbers; a missing component is 0, and alpha 1."""
    try:
        values.parse_color(node, text)
    except FormatError as error:
        found = _numbers(text)
        if not found:
            raise
        return _taken([*found, "0", "0"][: max(3, min(4, len(found)))], error, reading)
    return text


def pose(node: Parameters, reading: Reading) -> Parameters:
    """Return a ``<pose>``: of more than six numbers the first six, of fewer the position alone.

    Raises:
        FormatError: It does not begin with a number, or is a quaternion of another length.
    """
    quaternion = node.attributes.get("rotation_format", "euler_rpy") == "quat_xyzw"
    if quaternion or not node.text:
        return node
    try:
        values.parse_reals(node, node.text, "<pose>", _POSE)
    except FormatError as error:
        found = _numbers(node.text)
        if not found:
            raise
        kept = found[:_POSE] if len(found) >= _POSE else found[:_POSITION]
        zeros = ["0"] * (_POSE - len(kept))
        return replace(node, text=_taken([*kept, *zeros], error, reading))
    return node


def noise(node: Parameters, reading: Reading) -> Parameters:
    """Return a ``<noise>``; one of an unknown type is none."""
    child = node.find("type")
    kind = node.attributes.get("type", "") or ("" if child is None else child.text)
    if kind in _NOISES:
        return node
    reading.fault(
        f"unknown noise '{kind}': none was taken",
        node,
        f"there are: {', '.join(sorted(_NOISES - {''}))}",
    )
    return with_attributes(node, type="none")


def span(node: Parameters, reading: Reading) -> Parameters:
    """Return a ``<range>`` of a lidar: it grows from 0.

    Raises:
        FormatError: A limit is not a number.
    """
    if node.find("min") is None or node.find("max") is None:
        return node
    near, far = values.real(node, "min", 0.0), values.limit(node, "max", 0.0)
    if 0.0 <= near <= far:
        return node
    least, most = sorted(max(limit, 0.0) for limit in (near, far))
    reading.fault(
        f"the range must grow from 0, found {near:g} to {far:g}: {least:g} to {most:g} was taken",
        node,
    )
    for tag, limit in (("min", least), ("max", most)):
        node = with_child(node, made(tag, repr(limit), like=node))
    return node


PARTS: dict[str, Callable[[Parameters, Reading], Parameters]] = {
    "noise": noise,
    "pose": pose,
    "range": span,
}
"""Functions that repair elements, by tag."""


def part(node: Parameters, reading: Reading) -> Parameters:
    """Return the element, repaired if it is one of ``PARTS``."""
    mend = PARTS.get(node.tag)
    return node if mend is None else mend(node, reading)


def _numbers(text: str) -> list[str]:
    """Return the numbers that a text begins with; a comma behind one does no harm."""
    found = []
    for word in text.replace(",", " ").split():
        start = _START.match(word)
        if start is None:
            break
        found.append(start[0])
        if start.end() < len(word):
            break
    return found


def _taken(numbers: list[str], error: FormatError, reading: Reading) -> str:
    text = " ".join(numbers)
    reading.tolerate(error, f"'{text}' was taken")
    return text
