"""Refusal of NaN in the numbers of a description.

Infinite numbers pass: a joint without limits has them. What a field allows is checked by its users.
"""

from __future__ import annotations

import functools
import re
from collections.abc import Mapping
from dataclasses import fields
from typing import Any, TypeVar

from gazelle.description.pose import Pose
from gazelle.errors import FormatError

T = TypeVar("T")

_NUMBERS = re.compile(r"\b(float|Vector3|Pose|Color)\b")


def refuses_nan(kind: type[T]) -> type[T]:
    """Decorate a dataclass of a description so that no number of it is NaN.

    Raises:
        FormatError: One is; raised by the constructor.
    """
    names = tuple(each.name for each in fields(kind) if _NUMBERS.search(str(each.type)))  # type: ignore[arg-type]
    make: Any = kind.__init__

    @functools.wraps(make)
    def checking(self: T, *positional: Any, **named: Any) -> None:
        make(self, *positional, **named)
        for name in names:
            if _has_nan(value := getattr(self, name)):
                raise FormatError(f"{kind.__name__} takes no NaN: {name} is {value!r:.60}")

    kind.__init__ = checking  # type: ignore[assignment]
    return kind


def _has_nan(value: Any) -> bool:
    if isinstance(value, float):
        return value != value  # noqa: PLR0124  # so is NaN, and no function is called
    if isinstance(value, tuple | list):
        return any(map(_has_nan, value))
    if isinstance(value, Pose):
        return _has_nan(value.position) or _has_nan(value.quaternion)
    return isinstance(value, Mapping) and any(map(_has_nan, value.values()))
