"""Values of ROS parameters, checked against the kinds of their defaults."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import MISSING, Field, fields
from typing import Any

from gazelle_ros.base.errors import Error
from gazelle_ros.base.real_numbers import real

Values = Mapping[str, Any]


def value_of(values: Values, name: str, default: Any) -> Any:
    """Return a parameter, of the kind of its default.

    Raises:
        Error: It is of another kind.
    """
    found = values.get(name, default)
    kind = type(default)
    number = real(found)
    if kind is float and number is not None:
        return number
    if kind is int and isinstance(found, float) and found.is_integer():
        return int(found)
    if isinstance(found, kind) and not (kind is int and isinstance(found, bool)):
        return found
    raise Error(f"the parameter '{name}' is a {kind.__name__}, not {found!r:.60}")


def fields_of(kind: type[Any], values: Values, *, without: Collection[str] = ()) -> dict[str, Any]:
    """Return the parameters that a dataclass of settings has, each of the kind of its default.

    Args:
        kind: The dataclass.
        values: The parameters.
        without: Fields that are no such parameters.

    Raises:
        Error: One is of another kind.
    """
    return {
        each.name: value_of(values, each.name, _default_of(each))
        for each in fields(kind)
        if each.init and each.name not in without
    }


def _default_of(each: Field[Any]) -> Any:
    return each.default if each.default_factory is MISSING else each.default_factory()
