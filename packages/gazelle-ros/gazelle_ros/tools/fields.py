"""Parts of messages by path: ``/pose/position/x``, ``/ranges[0]``, ``/points[1:3]/x``."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from gazelle_ros.base.errors import did_you_mean
from gazelle_ros.messages import Message, load_message
from gazelle_ros.tools.errors import ToolError

_STEP = re.compile(r"(\w+)(?:\[([^\]]*)\])?", re.ASCII)
_INDEX = re.compile(r"-?\d+")
_SLICE = re.compile(r"(-?\d+)?:(-?\d+)?(?::(-?\d+)?)?")


@dataclass(frozen=True, slots=True)
class FieldAccess:
    """One field, and an index or slice of it."""

    name: str
    index: int | slice | None


def parse_path(text: str) -> list[FieldAccess]:
    """Parse the steps of a path.

    Raises:
        ToolError: A step is malformed.
    """
    return [_step(part) for part in text.split("/") if part]


def _step(part: str) -> FieldAccess:
    match = _STEP.fullmatch(part)
    if match is None:
        raise ToolError(f"'{part}' is not a field", hint="write name, name[0] or name[1:3]")
    name, inner = match.groups()
    if inner is None:
        return FieldAccess(name, None)
    if _INDEX.fullmatch(inner):
        return FieldAccess(name, int(inner))
    bounds = _SLICE.fullmatch(inner)
    if bounds is None:
        raise ToolError(f"'[{inner}]' is not an index", hint="write [0] or [1:3]")
    start, stop, stride = (None if each is None else int(each) for each in bounds.groups())
    return FieldAccess(name, slice(start, stop, stride))


def value_at(message: Any, steps: Sequence[FieldAccess]) -> Any:
    """Return the part of a message at a path; of a slice, the parts of all its elements.

    Raises:
        ToolError: There is no such field or element.
    """
    value = message
    for number, step in enumerate(steps):
        try:
            value = getattr(value, step.name)
        except AttributeError:
            known = getattr(value, "__slots__", ())
            raise ToolError(
                f"there is no field '{step.name}'", hint=did_you_mean(step.name, known)
            ) from None
        if step.index is None:
            continue
        try:
            value = value[step.index]
        except (IndexError, TypeError) as error:
            raise ToolError(f"{step.name}[{step.index}]: {error}") from None
        if isinstance(step.index, slice):
            return [value_at(each, steps[number + 1 :]) for each in value]
    return value


def type_at(message_class: type[Message], steps: Sequence[FieldAccess]) -> str:
    """Return the type of the field at a path, as in its definition.

    Raises:
        ToolError: There is no such field.
    """
    kind = message_class._type
    for step in steps:
        current = message_class if kind == message_class._type else load_message(kind)
        if step.name not in current.__slots__:
            hint = did_you_mean(step.name, current.__slots__)
            raise ToolError(f"{kind} has no field '{step.name}'", hint=hint)
        kind = current._slot_types[list(current.__slots__).index(step.name)]
        if step is not steps[-1] or step.index is not None:
            kind = kind.partition("[")[0]
    return kind


def keep_text_fields(message: Message, arguments: Sequence[Any]) -> list[Any]:
    """Return values of a command line, with numbers for text fields as text.

    ``2.0`` and ``max`` are both words for people; YAML makes a number of the first.
    """
    kinds = dict(zip(message.__slots__, message._slot_types, strict=True))
    if len(arguments) == 1 and isinstance(arguments[0], dict):
        return [{name: _text(kinds.get(name), each) for name, each in arguments[0].items()}]
    if len(arguments) != len(kinds):
        return list(arguments)
    return [_text(kind, each) for kind, each in zip(kinds.values(), arguments, strict=True)]


def _text(kind: str | None, value: Any) -> Any:
    number = isinstance(value, int | float) and not isinstance(value, bool)
    return str(value) if kind == "string" and number else value
